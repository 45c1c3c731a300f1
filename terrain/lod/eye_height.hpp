/// How high an eye is above the terrain, from what is loaded of it.
#pragma once

#include "terrain/geodesy/position.hpp"
#include "terrain/pager/tile_tree.hpp"

namespace eyepoint::terrain {

/// Metres along the vertical; never more than the true height above the full-resolution surface, and less by
/// up to the relief of the deepest loaded tile beneath the eye. Negative below the surface, or where too
/// little is loaded to know better.
[[nodiscard]] double least_height_above_ground_m(TileTree& tree, const Ecef& eye);

}  // namespace eyepoint::terrain
