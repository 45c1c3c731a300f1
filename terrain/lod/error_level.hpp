/// The scale of geometric errors that nested meshes are made to, and the level that a view asks for at a
/// distance.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "terrain/geodesy/position.hpp"
#include "terrain/tiling/tile_id.hpp"

namespace eyepoint::terrain {

/// A mesh of level k is nowhere farther from the full-resolution surface than E_k = kFinestErrorM * 2^(k/2),
/// metres: two levels to a doubling.
inline constexpr double kFinestErrorM = 1.0 / 1024.0;
/// The coarsest level there is; its error (3,000 km) is that of any mesh of the Earth.
inline constexpr std::uint8_t kLastLevel = 63;
inline constexpr std::size_t kLevels = kLastLevel + 1;

[[nodiscard]] inline double level_error_m(int level) { return kFinestErrorM * std::exp2(0.5 * level); }

/// The finest level with at least this error, 0..kLastLevel.
[[nodiscard]] inline std::uint8_t level_of_error(double error_m) {
    if (!(error_m > kFinestErrorM)) return 0;
    return static_cast<std::uint8_t>(
        std::min(std::ceil(2.0 * std::log2(error_m / kFinestErrorM) - 1e-9), double{kLastLevel}));
}

/// No triangle of a mesh of level k has a side longer than kLevelReachM * 2^(k/2), metres, but for those of
/// the full-resolution grids, of polar tiles, and the exceptions of the compiler (docs/lod.md, "Collapse").
/// So what a vertex does at level k is felt within that distance of it only, and it may do it once the
/// nearest place where it is felt, not just its own, is far enough away for the level.
inline constexpr double kLevelReachM = 1.0 / 8.0;

[[nodiscard]] inline double level_reach_m(int level) { return kLevelReachM * std::exp2(0.5 * level); }

/// The finest level at which triangles may have sides so long, 0..kLastLevel.
[[nodiscard]] inline std::uint8_t level_of_reach(double side_m) {
    return level_of_error(side_m * (kFinestErrorM / kLevelReachM));
}

/// Of a tolerance, the share that levels are chosen by. The rest covers what the compiler does not check:
/// triangles of two levels, errors while vertices slide by unequal shares (docs/lod.md).
inline constexpr double kToleranceShare = 0.97;

/// Level that a tolerance allows at a distance D: lambda = 2 log2(D * scale), a real number, below 0 where
/// even level 0 is too coarse. A vertex may go at level k when all of the ground within its reach is so far
/// away that E_k is within the tolerance there (epsilon = kappa * delta / distance, design, "Level of
/// detail"): D - reach_k >= kappa * E_k / (share * tau). Both sides' k is in 2^(k/2) alone, so 1 / scale =
/// kappa * E_0 / (share * tau) + reach_0.
[[nodiscard]] inline double level_scale(double tau_px, double kappa_px) {
    return 1.0 / (kappa_px * kFinestErrorM / (kToleranceShare * tau_px) + kLevelReachM);
}
[[nodiscard]] inline double level_at(double distance_m, double scale) {
    return 2.0 * std::log2(std::max(distance_m * scale, 1e-9));
}
/// The distances at which level_at() is a level and a margin; scale 1.
[[nodiscard]] inline std::array<double, kLevels> unit_distances_m(double margin_levels) {
    std::array<double, kLevels> result{};
    for (std::size_t level = 0; level < kLevels; ++level)
        result[level] = std::exp2((static_cast<double>(level) + margin_levels) / 2.0);
    return result;
}

/// From this latitude on, a border of tiles, those of this depth and deeper are so narrow that splitting
/// tiles for the size of their triangles would take thousands: there only their errors count.
inline constexpr double kPolarLatitudeDeg = 90.0 - 180.0 / 128.0;
inline constexpr std::uint32_t kPolarDepth = 9;

[[nodiscard]] inline bool is_polar(TileId tile) {
    const GeographicExtent sides = extent(tile);
    return tile.depth >= kPolarDepth &&
           (sides.south_deg >= kPolarLatitudeDeg || sides.north_deg <= -kPolarLatitudeDeg);
}

/// bare_level, by whether the tile is_polar().
[[nodiscard]] inline std::uint8_t bare_level(std::uint32_t depth, bool polar) {
    constexpr double kRadiusM = 6.4e6;  // not less than any radius of curvature of WGS84
    const double cell_rad = post_spacing_deg(depth) * 3.14159265358979323846 / 180.0;
    const std::uint8_t round = level_of_error(kRadiusM * cell_rad * cell_rad / 8.0 * (1.0 + std::sqrt(5.0)));
    if (round == 0 || polar) return round;
    return std::max(round, level_of_reach(std::sqrt(2.0) * kRadiusM * cell_rad));
}

/// First level of a tile that has no stored children: that of the error that flat triangles between its posts
/// have because the Earth is round (the remainder of linear interpolation, tools/terrain/compile_error.hpp)
/// and of their size. Finer levels are drawn by its virtual children, down to the depth where the Earth is
/// flat between posts: that has level 0 and no children.
[[nodiscard]] inline std::uint8_t bare_level(TileId tile) { return bare_level(tile.depth, is_polar(tile)); }

/// The level at which posts of a virtual tile that its parent does not have go, by the tile's depth and their
/// latitude: the parent's bare level; of posts on a border of tiles the lower one of both sides.
[[nodiscard]] inline std::uint8_t virtual_post_level(std::uint32_t depth, double latitude_deg) {
    return bare_level(depth - 1, depth > kPolarDepth && std::abs(latitude_deg) >= kPolarLatitudeDeg);
}

}  // namespace eyepoint::terrain
