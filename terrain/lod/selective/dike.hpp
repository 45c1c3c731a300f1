/// Dikes: the triangles between two blocks that share an edge and have different vertices on it. Source: Ueng
/// & Chuang, section 4.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "terrain/block/block.hpp"
#include "terrain/tiling/tile_edges.hpp"

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

/// What is across each edge (kEdges) of a block that owns the dike there: the vertices on the far side, as
/// posts of the block, and kDike beside their bits; 0: it owns none.
using FarSides = std::array<std::uint32_t, 4>;
inline constexpr std::uint32_t kDike = 1;

/// A dike is made of vertices that one block has, all of them, so it is drawn with that block's: of two of
/// one depth the western or southern one's; of two depths the finer one's, whose posts the coarser one's are.
/// Only where a coarser block leaves out the vertex in which two finer ones meet on its edge, it has a dike
/// up to that.
/// own: the block's vertices on its edges. across(edge): the leaves there, as of TileCut::across;
/// border_of(leaf): their vertices.
template <typename Border, typename Across, typename BorderOf>
[[nodiscard]] FarSides far_sides(TileId tile, const Border& own, const Across& across,
                                 const BorderOf& border_of) {
    FarSides far{};
    for (const Edge edge : kEdges) {
        const auto leaves = across(edge);
        const auto at = static_cast<std::size_t>(edge),
                   opposite_at = static_cast<std::size_t>(opposite(edge));
        if (leaves[0] != leaves[1]) {
            far[at] = own[at] | kMiddleVertex | kDike;
            continue;
        }
        if (leaves[0] == nullptr) continue;
        const EdgeVertices beyond = border_of(*leaves[0])[opposite_at];
        if (leaves[0]->tile.depth == tile.depth) {
            if (edge == Edge::East || edge == Edge::North) far[at] = beyond | kDike;
            continue;
        }
        const bool upright = edge == Edge::West || edge == Edge::East;
        far[at] = half_of_edge(beyond, static_cast<int>((upright ? tile.y : tile.x) & 1U)) | kDike;
    }
    return far;
}

/// All dikes of a block.
void append_dikes(const FarSides& far, std::span<const EdgeVertices, 4> own, const BlockData& block,
                  std::vector<std::uint16_t>& indices);

}  // namespace eyepoint::terrain::selective
