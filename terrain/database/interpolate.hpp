/// Heights in whole quanta (Manifest::height_step_m), and the one rule by which a height between two posts is
/// made. The compiler makes the odd posts of an edge beside a coarser tile by it, and a reader the posts of
/// virtual tiles (virtual_tile.hpp): so both sides of such an edge hold the same numbers.
#pragma once

#include <cmath>
#include <cstdint>

namespace eyepoint::terrain {

/// The nearest whole number of quanta; halves away from zero. Height in -100 km..100 km, step at least 0.1
/// mm.
[[nodiscard]] inline std::int32_t to_quanta(double height_m, double height_step_m) {
    return static_cast<std::int32_t>(std::lround(height_m / height_step_m));
}

/// The height every reader sees for a stored number of quanta.
[[nodiscard]] inline float to_metres(std::int32_t quanta, double height_step_m) {
    return static_cast<float>(quanta * height_step_m);
}

/// floor((a + b) / 2): symmetric, at most half a quantum below the mean.
[[nodiscard]] constexpr std::int32_t midpoint(std::int32_t a, std::int32_t b) {
    return static_cast<std::int32_t>((std::int64_t{a} + b) >> 1);
}

}  // namespace eyepoint::terrain
