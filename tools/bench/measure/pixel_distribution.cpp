#include "tools/bench/measure/pixel_distribution.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace eyepoint::tools {

namespace {

/// A positive float's bits, read as an integer, rise with its value: exponent and leading bits of the
/// fraction are the bin's number.
constexpr int kFractionBitsLost = 13;
constexpr std::uint32_t kLeastExponent = 127 - 20, kMostExponent = 127 + 19;
constexpr std::uint32_t kBinsADoubling = 1U << (23 - kFractionBitsLost);
constexpr std::size_t kBins = (kMostExponent - kLeastExponent) * kBinsADoubling + 1;

std::size_t bin_of(float px) {
    const std::uint32_t number = std::bit_cast<std::uint32_t>(px) >> kFractionBitsLost;
    constexpr std::uint32_t kFirst = kLeastExponent * kBinsADoubling;
    return number < kFirst ? 0 : std::min<std::size_t>(number - kFirst + 1, kBins - 1);
}

double upper_bound_of(std::size_t bin) {
    if (bin == 0) return 0.0;
    const auto number = static_cast<std::uint32_t>(bin) + kLeastExponent * kBinsADoubling;
    return std::bit_cast<float>(number << kFractionBitsLost);
}

}  // namespace

void PixelDistribution::add(float px) {
    if (bins_.empty()) bins_.resize(kBins);
    ++bins_[bin_of(px)];
    ++count_;
    sum_of_squares_ += static_cast<double>(px) * px;
    maximum_ = std::max(maximum_, px);
}

void PixelDistribution::merge(const PixelDistribution& other) {
    if (other.count_ == 0) return;
    if (bins_.empty()) bins_.resize(kBins);
    for (std::size_t i = 0; i < kBins; ++i) bins_[i] += other.bins_[i];
    count_ += other.count_;
    sum_of_squares_ += other.sum_of_squares_;
    maximum_ = std::max(maximum_, other.maximum_);
}

double PixelDistribution::rms() const {
    return count_ == 0 ? 0.0 : std::sqrt(sum_of_squares_ / static_cast<double>(count_));
}

double PixelDistribution::percentile(double share) const {
    const auto rank = static_cast<std::uint64_t>(std::ceil(share * static_cast<double>(count_)));
    std::uint64_t below = 0;
    for (std::size_t bin = 0; bin < bins_.size(); ++bin) {
        below += bins_[bin];
        if (below >= rank) return std::min<double>(upper_bound_of(bin), maximum_);
    }
    return 0.0;
}

}  // namespace eyepoint::tools
