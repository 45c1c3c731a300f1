#include "ig/distribution.hpp"

#include <algorithm>
#include <cmath>

namespace eyepoint::ig {

namespace {

/// A bin's bounds are this factor apart and it is reported as their geometric mean, so the error is its root.
constexpr double kGrowth = (1.0 + Distribution::kRelativeError) * (1.0 + Distribution::kRelativeError);

std::size_t bin_of(double value) {
    const double bounded = std::clamp(value, Distribution::kLeast, Distribution::kMost);
    return static_cast<std::size_t>(std::log(bounded / Distribution::kLeast) / std::log(kGrowth));
}

double middle_of(std::size_t bin) {
    return Distribution::kLeast * std::pow(kGrowth, static_cast<double>(bin) + 0.5);
}

}  // namespace

Distribution::Distribution() : bins_(bin_of(kMost) + 1) {}

void Distribution::add(double value) {
    if (std::isnan(value)) return;
    ++bins_[bin_of(value)];
    maximum_ = count_ == 0 ? value : std::max(maximum_, value);
    ++count_;
}

double Distribution::percentile(double share) const {
    const auto rank = static_cast<std::uint64_t>(std::ceil(share * static_cast<double>(count_)));
    std::uint64_t below = 0;
    for (std::size_t bin = 0; bin < bins_.size(); ++bin) {
        below += bins_[bin];
        if (below >= std::max<std::uint64_t>(rank, 1)) return std::min(middle_of(bin), maximum_);
    }
    return maximum_;
}

}  // namespace eyepoint::ig
