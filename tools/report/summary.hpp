/// What a column of a frame record comes to.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace eyepoint::tools {

struct Percentiles {
    double p50 = 0.0, p95 = 0.0, p99 = 0.0, maximum = 0.0;
};

/// Nearest-rank percentiles (the least value that so many percent do not exceed) of the values that are not
/// NaN; none where there is no such value.
[[nodiscard]] std::optional<Percentiles> percentiles(std::span<const double> values);

enum class Thinning : std::uint8_t {
    Largest,  ///< a point is the worst of its frames: for what a frame costs
    First,    ///< a point is its first frame: for time and place
};

/// One value for every `step` values, the last group perhaps smaller; NaN only where a whole group is NaN
/// (Largest) or its first value is (First). step >= 1.
[[nodiscard]] std::vector<double> thin(std::span<const double> values, std::size_t step, Thinning thinning);

}  // namespace eyepoint::tools
