/// Errors of millions of posts, in pixels: their greatest, their percentiles and their root mean square.
#pragma once

#include <cstdint>
#include <vector>

namespace eyepoint::tools {

/// Counts values in bins that are 1/1024 of a doubling wide. Greatest, mean square and count are exact, a
/// percentile is at most 0.1% above its true value; values under 2^-20 px count as 0. Thread use: one thread;
/// merge() joins what several threads have counted.
class PixelDistribution {
  public:
    /// px >= 0 and finite.
    void add(float px);
    void merge(const PixelDistribution& other);

    [[nodiscard]] std::uint64_t count() const { return count_; }
    [[nodiscard]] double maximum() const { return maximum_; }
    [[nodiscard]] double rms() const;
    /// The value that `share` (0..1) of all values do not exceed (nearest rank); 0 when nothing was added.
    [[nodiscard]] double percentile(double share) const;

  private:
    std::vector<std::uint64_t> bins_;  ///< empty until something was added
    std::uint64_t count_ = 0;
    double sum_of_squares_ = 0.0;
    float maximum_ = 0.0F;
};

}  // namespace eyepoint::tools
