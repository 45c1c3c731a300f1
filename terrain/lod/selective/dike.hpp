/// Dikes: the triangles between two blocks that share an edge and have different vertices on it. Source: Ueng
/// & Chuang, section 4.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "terrain/block/block.hpp"
#include "terrain/tiling/tile_id.hpp"

namespace eyepoint::terrain::selective {

/// Vertices of an edge of posts 0 to n: bit k for post k, 0 < k < n. Both ends always are vertices.
using EdgeVertices = std::uint32_t;

/// A triangle's corners, as posts of the edge. An edge from a higher post to a lower one is on the side of
/// the near block if it is one of the near block's edges.
using DikeTriangle = std::array<int, 3>;

/// The paper triangulates a dike completely, a strip between the two rows of posts, and collapses the edges
/// at posts that are not vertices of their side. Here the two rows are the same posts, in both blocks; what
/// is left are the vertical slivers between the two blocks' border lines. Returns the strip after all
/// collapses, without triangles two corners of which are one post. A post collapses into the vertex of its
/// side before it or after it, step by step so that the sliver's new side is nearer to the posts it passes.
///
/// Where a sliver's side runs, one block's border is a straight line, and it begins on that line and ends at
/// a post, or the reverse: so it is nowhere farther from the posts than twice what that line is.
///
/// heights_m: of the posts. Oriented for a near block whose triangles run along the edge from lower posts to
/// higher ones.
[[nodiscard]] std::vector<DikeTriangle> dike(EdgeVertices near, EdgeVertices far,
                                             std::span<const float> heights_m);

/// Vertices of one half (0: the one with post 0) of a 33-post edge, as posts of the edge of a block of the
/// next depth that lies along that half.
[[nodiscard]] EdgeVertices half_of_edge(EdgeVertices vertices, int half);

/// The middle post of a 33-post edge. Where a block lies beside two of the next depth, these meet in it, and
/// it is a vertex of theirs: a dike from the block's own vertices to the same with the middle goes first, and
/// each half has a dike of its own.
inline constexpr EdgeVertices kMiddleVertex = 1U << 16;

/// The same on a block's edge: appends corners as numbers of Block::vertices.
void append_dike(Edge edge, EdgeVertices near, EdgeVertices far, const BlockData& block,
                 std::vector<std::uint16_t>& indices);

}  // namespace eyepoint::terrain::selective
