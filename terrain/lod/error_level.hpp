/// The scale of geometric errors that nested meshes are made to, and the level that a view asks for at a
/// distance.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "terrain/geodesy/position.hpp"
#include "terrain/tiling/tile_id.hpp"

namespace eyepoint::terrain {

/// A mesh of level k is nowhere farther from the full-resolution surface than E_k = kFinestErrorM * 2^(k/2),
/// metres: two levels to a doubling.
inline constexpr double kFinestErrorM = 1.0 / 1024.0;
/// The coarsest level there is; its error (3,000 km) is that of any mesh of the Earth.
inline constexpr std::uint8_t kLastLevel = 63;

[[nodiscard]] inline double level_error_m(int level) { return kFinestErrorM * std::exp2(0.5 * level); }

/// The finest level with at least this error, 0..kLastLevel.
[[nodiscard]] inline std::uint8_t level_of_error(double error_m) {
    if (!(error_m > kFinestErrorM)) return 0;
    return static_cast<std::uint8_t>(
        std::min(std::ceil(2.0 * std::log2(error_m / kFinestErrorM) - 1e-9), double{kLastLevel}));
}

/// Of a tolerance, the share that levels are chosen by. Every vertex moves by the level of its own distance,
/// so a post lies between vertices that are farther than it and may be coarser than its own distance allows;
/// measured over flights, an error exceeds its level's by up to a sixth (docs/lod.md).
inline constexpr double kToleranceShare = 0.84;

/// Level that a tolerance allows at a distance: lambda = 2 log2(distance * scale), with scale = share * tau /
/// (kappa * E_0); a real number, below 0 where even level 0 is too coarse. From epsilon = kappa * delta /
/// distance (design, "Level of detail") set equal to the share of tau.
[[nodiscard]] inline double level_scale(double tau_px, double kappa_px) {
    return kToleranceShare * tau_px / (kappa_px * kFinestErrorM);
}
[[nodiscard]] inline double level_at(double distance_m, double scale) {
    return 2.0 * std::log2(std::max(distance_m * scale, 1e-9));
}

/// First level of a tile that has no stored children: the error that flat triangles between its posts have
/// because the Earth is round (the remainder of linear interpolation, tools/terrain/compile_error.hpp). Finer
/// levels are drawn by its virtual children; at 0 there are none. One depth less is four levels more.
[[nodiscard]] inline std::uint8_t bare_level(std::uint32_t depth) {
    constexpr double kRadiusM = 6.4e6;  // not less than any radius of curvature of WGS84
    const double cell_rad = post_spacing_deg(depth) * 3.14159265358979323846 / 180.0;
    return level_of_error(kRadiusM * cell_rad * cell_rad / 8.0 * (1.0 + std::sqrt(5.0)));
}

}  // namespace eyepoint::terrain
