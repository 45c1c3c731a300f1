#include "tools/bench/regression/block_bootstrap.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

namespace eyepoint::tools {

namespace {

constexpr std::size_t kFlights = 1000;

/// Uniform in 0..1, the same on every machine.
double uniform(std::mt19937_64& random) { return static_cast<double>(random() >> 11U) * 0x1p-53; }

void choose(std::mt19937_64& random, double mean_run, std::vector<std::uint32_t>& choice) {
    const std::size_t frames = choice.size();
    const auto anywhere = [&] {
        return std::min(static_cast<std::size_t>(uniform(random) * static_cast<double>(frames)), frames - 1);
    };
    std::size_t at = anywhere();
    for (std::uint32_t& chosen : choice) {
        chosen = static_cast<std::uint32_t>(at);
        at = uniform(random) * mean_run < 1.0 ? anywhere() : (at + 1) % frames;
    }
}

/// Mean products of a series about its mean with itself, lag frames later.
class Autocovariance {
  public:
    explicit Autocovariance(std::span<const double> series) : deviation_(series.begin(), series.end()) {
        const double mean =
            std::accumulate(series.begin(), series.end(), 0.0) / static_cast<double>(series.size());
        for (double& value : deviation_) value -= mean;
    }
    [[nodiscard]] double at(std::size_t lag) const {
        double sum = 0.0;
        for (std::size_t i = lag; i < deviation_.size(); ++i) sum += deviation_[i] * deviation_[i - lag];
        return sum / static_cast<double>(deviation_.size());
    }

  private:
    std::vector<double> deviation_;
};

/// The least lag after which several correlations in a row are insignificant.
std::size_t last_significant_lag(const Autocovariance& covariance, std::size_t length, std::size_t most) {
    const double digits = std::log10(static_cast<double>(length));
    const double threshold = 2.0 * std::sqrt(digits / static_cast<double>(length));
    const auto in_a_row = static_cast<std::size_t>(std::max(5.0, std::ceil(std::sqrt(digits))));
    const double variance = covariance.at(0);
    std::size_t last = 0;
    for (std::size_t lag = 1; lag <= most && lag <= last + in_a_row; ++lag)
        if (std::abs(covariance.at(lag) / variance) > threshold) last = lag;
    return last;
}

}  // namespace

Interval bootstrap(std::size_t frames, double mean_run, const std::function<double(FrameChoice)>& figure) {
    std::vector<std::uint32_t> choice(frames);
    std::iota(choice.begin(), choice.end(), 0U);
    Interval interval;
    interval.value = figure(choice);
    std::mt19937_64 random{20040101};
    std::vector<double> figures(kFlights);
    for (double& one : figures) {
        choose(random, mean_run, choice);
        one = figure(choice);
    }
    std::sort(figures.begin(), figures.end());
    constexpr std::size_t kTail = kFlights / 40;
    interval.low = figures[kTail - 1];
    interval.high = figures[kFlights - kTail];
    return interval;
}

double mean_run_length(std::span<const double> series) {
    const std::size_t length = series.size();
    const Autocovariance covariance{series};
    if (length < 4 || covariance.at(0) <= 0.0) return 1.0;
    const double root = std::sqrt(static_cast<double>(length));
    const double longest = std::max(1.0, std::min(3.0 * root, static_cast<double>(length) / 3.0));
    const auto most_lag = std::min(static_cast<std::size_t>(std::ceil(root)) + 5, length - 1);
    const std::size_t window =
        std::min(2 * std::max<std::size_t>(last_significant_lag(covariance, length, most_lag), 1), most_lag);
    double spectrum = covariance.at(0), slope = 0.0;
    for (std::size_t lag = 1; lag <= window; ++lag) {
        const double share = static_cast<double>(lag) / static_cast<double>(window);
        const double weight = share <= 0.5 ? 1.0 : 2.0 * (1.0 - share);
        spectrum += 2.0 * weight * covariance.at(lag);
        slope += 2.0 * weight * static_cast<double>(lag) * covariance.at(lag);
    }
    if (spectrum == 0.0) return longest;
    const double ratio = slope / spectrum;  // G^2 / D, with D = 2 spectrum^2
    return std::clamp(std::cbrt(ratio * ratio * static_cast<double>(length)), 1.0, longest);
}

}  // namespace eyepoint::tools
