/// Virtual tiles: tiles that no database stores, made by splitting a stored leaf (or another virtual tile),
/// so that a coarse surface follows the curve of the Earth close to the eye.
///
/// Heights of a virtual tile lie on its parent's triangles (every cell split from its south-west to its
/// north-east post), in latitude and longitude, rounded by midpoint() of interpolate.hpp: even posts are the
/// parent's; odd posts of an even row or column are the midpoint along it; the others the midpoint of the
/// cell's diagonal. The edge of a stored tile beside a leaf follows the same rule, so it equals the virtual
/// neighbour's, post by post and bit by bit. Thread use: pure functions, from any thread.
#pragma once

#include "terrain/database/database.hpp"

namespace eyepoint::terrain {

/// Heights with apron, water and undulations of a child, in the order of child(). Water: wet where both (or
/// on an even post, the one) of the posts it lies between are.
[[nodiscard]] BlockData subdivide(const BlockData& parent, int quadrant, double height_step_m);

/// What is known of a child of a leaf or of a virtual tile. delta_m are against the leaf's own surface; the
/// rounding of virtual heights (half a height step a generation) is not counted. Level l of the child has the
/// posts of the parent's level l-1, and its own level 0 a quarter of the parent's error, because the second
/// differences that make it (of the ellipsoid, and of the normal along a slope) are of cells of half the
/// side. Levels: from bare_level of the child's depth to the parent's first, which must not be 0.
[[nodiscard]] NodeInfo subdivide(const NodeInfo& parent, TileId child);

/// Nested mesh of a virtual tile: the whole grid, of which the posts that the parent does not have (odd row
/// or column) all go at the tile's last level (those on the border to polar tiles: virtual_post_level), an
/// edge's along the edge, the others to the south-west end of their half of a diagonal.
[[nodiscard]] NestedMesh virtual_mesh(TileId tile, std::uint8_t last_level);

}  // namespace eyepoint::terrain
