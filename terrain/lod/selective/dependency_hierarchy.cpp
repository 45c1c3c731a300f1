#include "terrain/lod/selective/dependency_hierarchy.hpp"

#include <algorithm>
#include <cstddef>

namespace eyepoint::terrain::selective {

namespace {

constexpr std::uint16_t kSouthWest = 0, kSouthEast = kBlockCells, kNorthWest = kBlockPosts * kBlockCells,
                        kNorthEast = kBlockVertices - 1;

/// Of a post that is no corner.
void describe_border(HierarchyVertex& vertex) {
    const int row = vertex.post / kBlockPosts, column = vertex.post % kBlockPosts;
    const auto on = [&](Edge edge, int place) {
        vertex.edge = static_cast<std::uint8_t>(edge);
        vertex.border_bit = 1U << place;
    };
    if (column == 0) on(Edge::West, row);
    if (column == kBlockCells) on(Edge::East, row);
    if (row == 0) on(Edge::South, column);
    if (row == kBlockCells) on(Edge::North, column);
}

}  // namespace

const DependencyHierarchy& DependencyHierarchy::of_block() {
    static const DependencyHierarchy hierarchy;
    return hierarchy;
}

/// While the hierarchy grows, ranks are posts.
DependencyHierarchy::DependencyHierarchy() : vertices_(kBlockVertices) {
    roots_[0].vertices = {kSouthEast, kNorthEast, kSouthWest};
    roots_[1].vertices = {kNorthWest, kSouthWest, kNorthEast};
    for (TreeTriangle& root : roots_) {
        root.middle = middle_post(root);
        grow(root, 0);
    }
    sort_bottom_up();
}

/// Enters the vertex that splits a triangle of a level, its child triangles, and what is below them.
void DependencyHierarchy::grow(const TreeTriangle& triangle, int level) {
    if (level == kLevels - 1) return;
    const auto [apex, left, right] = triangle.vertices;
    const std::uint16_t post = middle_post(triangle);
    HierarchyVertex& vertex = vertices_[post];
    vertex.post = post;
    vertex.level = static_cast<std::uint8_t>(level + 1);
    describe_border(vertex);
    if (level > 0) vertex.parents[vertex.triangle_count / 2] = apex;
    for (TreeTriangle child : {TreeTriangle{{post, apex, left}}, TreeTriangle{{post, right, apex}}}) {
        if (level + 1 < kLevels - 1) child.middle = middle_post(child);
        vertex.triangles[vertex.triangle_count++] = child;
        grow(child, level + 1);
    }
}

/// Also takes the corners, of level 0, out.
void DependencyHierarchy::sort_bottom_up() {
    std::stable_sort(vertices_.begin(), vertices_.end(),
                     [](const HierarchyVertex& a, const HierarchyVertex& b) { return a.level > b.level; });
    vertices_.resize(kRanks);
    ranks_.fill(kNoRank);
    for (std::size_t rank = 0; rank < kRanks; ++rank) ranks_[vertices_[rank].post] = static_cast<Rank>(rank);
    const auto to_rank = [&](Rank& post) { post = post == kNoRank ? kNoRank : ranks_[post]; };
    for (HierarchyVertex& vertex : vertices_) {
        for (Rank& parent : vertex.parents) to_rank(parent);
        for (TreeTriangle& triangle : vertex.triangles) to_rank(triangle.middle);
    }
    for (TreeTriangle& root : roots_) to_rank(root.middle);
}

}  // namespace eyepoint::terrain::selective
