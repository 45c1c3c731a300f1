#include "terrain/lod/hyperblock/quad_triangles.hpp"

#include <algorithm>

#include "terrain/lod/hyperblock/hyperblock_options.hpp"

namespace eyepoint::terrain::hyperblock {

using selective::DependencyHierarchy;
using selective::kNoRank;
using selective::Rank;
using selective::TreeTriangle;

namespace {

constexpr int kMostSide = 1 << kMostHyperLevel;

class Table {
  public:
    Table() {
        for (const TreeTriangle& root : DependencyHierarchy::of_block().roots()) enter(root, 0, {}, true);
    }
    [[nodiscard]] const QuadTriangles& at(const Quad& quad) const {
        return quads_[static_cast<std::size_t>(quad.depth)]
                     [static_cast<std::size_t>(quad.row * kMostSide + quad.column)];
    }

  private:
    /// Triangles of even levels have their legs along the grid: each is half of a quad.
    void enter(const TreeTriangle& triangle, int level, const TreeTriangle& whole, bool first) {
        if (level % 2 == 0) place(triangle, level / 2, whole, first);
        if (level == 2 * kMostHyperLevel) return;
        const auto& vertex = DependencyHierarchy::of_block().vertices()[triangle.middle];
        const std::size_t half = vertex.triangles[0].vertices[1] == triangle.vertices[0] ? 0 : 2;
        enter(vertex.triangles[half], level + 1, triangle, true);
        enter(vertex.triangles[half + 1], level + 1, triangle, false);
    }

    void place(const TreeTriangle& triangle, int depth, const TreeTriangle& whole, bool first) {
        int row = kBlockPosts, column = kBlockPosts;
        for (const int post : triangle.vertices) {
            row = std::min(row, post / kBlockPosts);
            column = std::min(column, post % kBlockPosts);
        }
        const int cells = kBlockCells >> depth;
        const auto number = static_cast<std::size_t>(row / cells * kMostSide + column / cells);
        const auto at = static_cast<std::size_t>(depth);
        QuadTriangles& quad = quads_[at][number];
        const std::size_t i = placed_[at][number]++;
        quad.roots[i] = triangle;
        quad.wholes[i] = whole;
        quad.is_first_half[i] = first;
    }

    template <typename T>
    using ByQuad = std::array<std::array<T, std::size_t{kMostSide} * kMostSide>, kMostHyperLevel + 1>;
    ByQuad<QuadTriangles> quads_{};
    ByQuad<std::size_t> placed_{};
};

bool upright(Edge edge) { return edge == Edge::West || edge == Edge::East; }

}  // namespace

const QuadTriangles& triangles_of(const Quad& quad) {
    static const Table table;
    return table.at(quad);
}

bool Quad::on_tile_edge(Edge edge) const {
    const int last = (1 << depth) - 1;
    switch (edge) {
        case Edge::West:
            return column == 0;
        case Edge::East:
            return column == last;
        case Edge::South:
            return row == 0;
        case Edge::North:
            return row == last;
    }
    return false;
}

selective::EdgeVertices Quad::posts_on(Edge edge) const {
    const int first = upright(edge) ? first_row() : first_column();
    const std::uint64_t posts = ((std::uint64_t{2} << cells()) - 1) << first;
    constexpr std::uint64_t kInner = (std::uint64_t{1} << kBlockCells) - 2;
    return static_cast<selective::EdgeVertices>(posts & kInner);
}

bool Quad::has_points_of(int level, const VertexSet& points) const {
    const DependencyHierarchy& hierarchy = DependencyHierarchy::of_block();
    const int step = kBlockCells >> level;
    for (int row_at = first_row(); row_at <= first_row() + cells(); row_at += step) {
        for (int at = first_column(); at <= first_column() + cells(); at += step) {
            const Rank rank = hierarchy.rank_of(static_cast<std::uint16_t>(row_at * kBlockPosts + at));
            if (rank != kNoRank && points[rank] && quad_level(hierarchy.vertices()[rank]) == level)
                return true;
        }
    }
    return false;
}

VertexSet Quad::extension(Edge edge, int level, const VertexSet& points) const {
    VertexSet result;
    if (level >= kQuadLevels) return result;
    const DependencyHierarchy& hierarchy = DependencyHierarchy::of_block();
    const int step = kBlockCells >> level;
    const bool far_side = edge == Edge::East || edge == Edge::North;
    const int across = (upright(edge) ? first_column() : first_row()) + (far_side ? cells() : 0),
              inward = far_side ? -step : step;
    for (int along = (upright(edge) ? first_row() : first_column()) + step, i = 0; i < cells() / step / 2;
         ++i, along += 2 * step) {
        const auto rank_at = [&](int from_edge) {
            const int row_at = upright(edge) ? along : across + from_edge,
                      column_at = upright(edge) ? across + from_edge : along;
            return hierarchy.rank_of(static_cast<std::uint16_t>(row_at * kBlockPosts + column_at));
        };
        const Rank rank = rank_at(0);
        if (!points[rank]) continue;
        result.set(rank);
        result.set(rank_at(inward));
    }
    return result;
}

}  // namespace eyepoint::terrain::hyperblock
