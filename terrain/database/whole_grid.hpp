/// The regular triangulation of a tile's own posts, the finest mesh of a tile without children.
#pragma once

#include <cstdint>
#include <span>

namespace eyepoint::terrain {

/// Three posts (row * kBlockPosts + column) a triangle, counterclockwise. Every cell is split from its
/// south-west to its north-east post, but for the ones in the tile's south-east and north-west corners: split
/// that way, their inner triangle would fold over when the posts of both edges slide away from the corner.
/// Thread use: any thread.
[[nodiscard]] std::span<const std::uint16_t> whole_grid_triangles();

}  // namespace eyepoint::terrain
