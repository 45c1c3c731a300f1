/// How coarse in the picture may be what is painted on a tile, before its children are drawn in its place.
#pragma once

#include <cmath>
#include <cstdint>

#include "terrain/tiling/tile_id.hpp"

namespace eyepoint::terrain {

/// A texel of a tile's picture may cover so many pixels.
inline constexpr double kMostPixelsATexel = 2.0;
/// The posts of a tile's relief (terrain/block/relief.hpp) may be so many pixels apart; they are
/// interpolated. Where the ground is rough, tiles give way to their children for their shape long before.
inline constexpr double kMostPixelsAPost = 8.0;

/// Distance of a tile's posts, metres on the ground, along the meridian.
[[nodiscard]] inline double post_spacing_m(std::uint32_t depth) {
    constexpr double kMetresPerDegree = 111320.0;
    return post_spacing_deg(depth) * kMetresPerDegree;
}

/// The level asked for (error_level.hpp, level_at) from which on the relief of a tile of depth 0 is fine
/// enough; two levels less for each depth. slack: s / tau; a choice once made stands until posts are so much
/// farther apart.
[[nodiscard]] inline double coarsest_relief_level(double kappa_px, double slack, double scale) {
    return 2.0 * std::log2(kappa_px * post_spacing_m(0) / (kMostPixelsAPost * (1.0 + slack)) * scale);
}

}  // namespace eyepoint::terrain
