/// Percentiles of a long run in little memory.
#pragma once

#include <cstdint>
#include <vector>

namespace eyepoint::ig {

/// Counts positive values in bins whose bounds grow by a constant factor, so that a run of days takes no more
/// memory than one of seconds. Largest value and count are exact; a percentile is at most kRelativeError off
/// for values in kLeast..kMost, and what lies outside counts as that bound.
class Distribution {
  public:
    static constexpr double kRelativeError = 0.005;
    static constexpr double kLeast = 1e-4;
    static constexpr double kMost = 1e10;

    Distribution();

    void add(double value);

    [[nodiscard]] std::uint64_t count() const { return count_; }
    /// 0 when nothing was added.
    [[nodiscard]] double maximum() const { return maximum_; }
    /// The value that `share` (0..1) of all values do not exceed (nearest rank); 0 when nothing was added.
    [[nodiscard]] double percentile(double share) const;

  private:
    std::vector<std::uint64_t> bins_;
    std::uint64_t count_ = 0;
    double maximum_ = 0.0;
};

}  // namespace eyepoint::ig
