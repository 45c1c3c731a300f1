/// How coarse in the picture may be what is painted on a tile, before its children are drawn in its place.
#pragma once

#include <cmath>
#include <cstdint>

#include "terrain/geodesy/earth.hpp"
#include "terrain/lod/error_level.hpp"
#include "terrain/tiling/tile_id.hpp"

namespace eyepoint::terrain {

/// A texel of a tile's picture may cover so many pixels.
inline constexpr double kMostPixelsATexel = 2.0;
/// The posts of a tile's relief (terrain/block/relief.hpp) may be so many times the tolerance apart, as seen
/// along the meridian; they are interpolated. Where the ground is rough, tiles give way to their children for
/// their shape long before.
inline constexpr double kMostTolerancesAPost = 32.0;

/// The level asked for (error_level.hpp, level_at) from which on the relief of a tile that has children is
/// fine enough. A multiple of the tolerance and not of a pixel: so it is a level, like the tile's first, and
/// a greater tolerance saves triangles in flat country, too. 0 at a pole, where thousands of narrow tiles
/// meet.
[[nodiscard]] inline std::uint8_t relief_level(TileId tile) {
    if (is_polar(tile)) return 0;
    return level_of_error(post_spacing_deg(tile.depth) * kMetresPerDegree / kMostTolerancesAPost);
}

}  // namespace eyepoint::terrain
