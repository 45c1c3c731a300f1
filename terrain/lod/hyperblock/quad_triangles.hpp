/// Quads of the quadtree in a tile, and which triangles of the hierarchy fill them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "terrain/lod/hyperblock/point_set.hpp"
#include "terrain/lod/selective/dependency_hierarchy.hpp"

namespace eyepoint::terrain::hyperblock {

/// Its place among the quads of its depth, from the south-west.
struct Quad {
    int depth = 0;
    int row = 0, column = 0;

    [[nodiscard]] int cells() const { return kBlockCells >> depth; }
    [[nodiscard]] int first_row() const { return row * cells(); }
    [[nodiscard]] int first_column() const { return column * cells(); }
    /// Number of its middle post.
    [[nodiscard]] std::size_t centre() const {
        return static_cast<std::size_t>((first_row() + cells() / 2) * kBlockPosts + first_column() +
                                        cells() / 2);
    }
    /// The quad of the depth above. depth: at least 1.
    [[nodiscard]] Quad around() const { return {depth - 1, row / 2, column / 2}; }
    [[nodiscard]] bool on_tile_edge(Edge edge) const;
    /// Its posts on that edge of the tile, ends included; the tile's corners left out.
    [[nodiscard]] selective::EdgeVertices posts_on(Edge edge) const;
    /// Whether any of the points is a vertex of a quadtree level, in the quad or on its edges.
    [[nodiscard]] bool has_points_of(int level, const VertexSet& points) const;
    /// The points of a quadtree level that are on an edge, and those in the quad that they depend on and that
    /// are of the same level. level: greater than the depth.
    [[nodiscard]] VertexSet extension(Edge edge, int level, const VertexSet& points) const;
};

/// The two triangles that a quad is cut into along a diagonal: they have its centre in the middle of their
/// bases.
struct QuadTriangles {
    std::array<selective::TreeTriangle, 2> roots{};
    /// Each is half of a larger one, split from that one's right angle to the root's; none for a whole tile.
    std::array<selective::TreeTriangle, 2> wholes{};
    std::array<bool, 2> is_first_half{};
};
/// depth: at most kMostHyperLevel.
[[nodiscard]] const QuadTriangles& triangles_of(const Quad& quad);

}  // namespace eyepoint::terrain::hyperblock
