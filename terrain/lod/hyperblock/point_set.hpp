/// The irregular point set of a tile, kept closed under the dependency relation of the restricted quadtree
/// triangulation. Source: HyperBlock-QuadTIN, sections 2 and 3; the dependency relation is the table of
/// terrain/lod/selective/dependency_hierarchy.hpp.
#pragma once

#include <array>
#include <bitset>
#include <cstdint>

#include "terrain/lod/selective/block_posts.hpp"
#include "terrain/lod/selective/block_selection.hpp"
#include "terrain/lod/selective/dependency_hierarchy.hpp"
#include "terrain/lod/selective/dike.hpp"

namespace eyepoint::terrain::hyperblock {

/// Vertices of a tile by rank (selective::DependencyHierarchy). The four corners always are vertices.
using VertexSet = std::bitset<selective::kRanks>;

/// Depths of the quadtree in a tile, from the whole tile to its cells.
inline constexpr int kQuadLevels = 6;
static_assert(1 << (kQuadLevels - 1) == kBlockCells);

/// Quadtree level at which a vertex comes in: the centres and edge middles of the quads of the level before.
[[nodiscard]] constexpr int quad_level(const selective::HierarchyVertex& vertex) {
    return (vertex.level + 1) / 2;
}

/// Adds what the vertices of a set depend on: for every vertex, the two it stands on.
void close_under_dependency(VertexSet& set);

/// How far a tile's surface may be from its point set's, all vertices drawn, metres: along the vertical, the
/// arc of the Earth included.
struct PointTolerance {
    float surface_m = 0.0F;  ///< against the tile with all its posts
    float arc_m = 0.0F;      ///< the arc alone
};
/// A share of what every second post would leave out (NodeInfo::delta_m[1]), so that it suits the ground.
/// Where every second post is interpolated that is nothing; so it is also that share of what it would be by
/// every fourth and eighth post on smooth ground, where it grows as the square.
[[nodiscard]] PointTolerance point_tolerance(TileId tile, const NodeInfo& info);

struct PointSet {
    VertexSet vertices;
    /// By quadtree level: those of this level and the coarser ones on the tile's edges.
    std::array<selective::BorderSelection, kQuadLevels> border{};
};

/// The least closed set that keeps to the tolerance. posts: of the tile; unseen_m: what they were made with.
[[nodiscard]] PointSet point_set(const selective::BlockPosts& posts, float unseen_m,
                                 const PointTolerance& tolerance);

/// Triangles with a middle at their base: those of the set in which that middle is missing are drawn. Calls
/// `leaf` with each below `triangle`, which must not be below one itself.
template <typename Leaf>
void triangulate(const VertexSet& set, const selective::TreeTriangle& triangle, const Leaf& leaf) {
    if (triangle.middle == selective::kNoRank || !set[triangle.middle]) {
        leaf(triangle);
        return;
    }
    const auto& vertex = selective::DependencyHierarchy::of_block().vertices()[triangle.middle];
    // A vertex has the two halves of the one triangle that it splits first, then those of the other.
    const std::size_t first = vertex.triangles[0].vertices[1] == triangle.vertices[0] ? 0 : 2;
    triangulate(set, vertex.triangles[first], leaf);
    triangulate(set, vertex.triangles[first + 1], leaf);
}

}  // namespace eyepoint::terrain::hyperblock
