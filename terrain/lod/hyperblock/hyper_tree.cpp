#include "terrain/lod/hyperblock/hyper_tree.hpp"

#include <algorithm>
#include <cstddef>

#include <glm/geometric.hpp>

#include "terrain/lod/hyperblock/hyperblock_options.hpp"
#include "terrain/lod/hyperblock/quad_triangles.hpp"
#include "terrain/lod/triangle_arc.hpp"
#include "terrain/tiling/tile_edges.hpp"

namespace eyepoint::terrain::hyperblock {

using selective::DependencyHierarchy;
using selective::kNoRank;
using selective::kRanks;
using selective::Rank;
using selective::TreeTriangle;

namespace {

/// Vertices up to a quadtree level, of which there are kQuadLevels.
const VertexSet& up_to_level(int level) {
    static const std::array<VertexSet, kQuadLevels> sets = [] {
        std::array<VertexSet, kQuadLevels> made;
        const auto vertices = DependencyHierarchy::of_block().vertices();
        for (std::size_t rank = 0; rank < kRanks; ++rank) {
            for (int at = quad_level(vertices[rank]); at < kQuadLevels; ++at)
                made[static_cast<std::size_t>(at)].set(rank);
        }
        return made;
    }();
    return sets[static_cast<std::size_t>(level)];
}

class Maker {
  public:
    Maker(const Block& tile, const selective::BlockPosts& posts, float unseen_m, const PointSet& points,
          int hyper_level)
        : posts_(posts), unseen_m_(unseen_m), points_(points.vertices) {
        cell_arc_m_ = static_cast<float>(arc_height_m(tile.data.tile.depth, selective::kLevels - 1));
        for (int post = 0; post < kBlockVertices; ++post) {
            const auto at = static_cast<std::size_t>(post);
            const Rank rank = hierarchy_.rank_of(static_cast<std::uint16_t>(post));
            from_origin_m_[at] = rank == kNoRank ? glm::vec3{tile.vertices[at].position() - posts.origin}
                                                 : glm::vec3{posts.x[rank], posts.y[rank], posts.z[rank]};
        }
        tree_.hyper_level = hyper_level;
        tree_.block_at.resize(static_cast<std::size_t>(tree_.side() * tree_.side()));
        const std::size_t most_blocks = tree_.block_at.size();
        tree_.blocks.reserve(most_blocks);
        tree_.nodes.reserve(most_blocks + most_blocks / 2);
        tree_.nodes.resize(1);
        add_node(0, {});
        tree_.indices.shrink_to_fit();
    }

    [[nodiscard]] HyperTree take() { return std::move(tree_); }

  private:
    /// 4.1, hyper-block generation: a branch goes on to hyperLevel, or ends early in a special block.
    void add_node(std::size_t number, const Quad& quad) {
        const bool divided = points_[triangles_of(quad).roots[0].middle];
        if (!divided || quad.depth == tree_.hyper_level) {
            add_block(number, quad, !divided);
            return;
        }
        const std::size_t first = tree_.nodes.size();
        tree_.nodes.resize(first + 4);
        tree_.nodes[number].first_child = static_cast<std::int16_t>(first);
        Sphere bounds{from_origin_m_[quad.centre()], 0.0F};
        for (int child = 0; child < 4; ++child) {
            const std::size_t at = first + static_cast<std::size_t>(child);
            add_node(at, {quad.depth + 1, quad.row * 2 + child / 2, quad.column * 2 + child % 2});
            const Sphere& below = tree_.nodes[at].bounds;
            bounds.radius_m =
                std::max(bounds.radius_m, glm::distance(bounds.centre_m, below.centre_m) + below.radius_m);
        }
        tree_.nodes[number].bounds = bounds;
    }

    void add_block(std::size_t number, const Quad& quad, bool special) {
        HyperBlock block;
        block.is_special = special;
        block.depth = static_cast<std::uint8_t>(quad.depth);
        block.row = static_cast<std::uint8_t>(quad.row);
        block.column = static_cast<std::uint8_t>(quad.column);
        const std::size_t first_index = tree_.indices.size();
        for (const Edge edge : kEdges)
            if (quad.on_tile_edge(edge)) block.on_tile_edge[index(edge)] = quad.posts_on(edge);
        if (special)
            make_special(quad, block);
        else
            make_levels(quad, block);
        block.bounds = bounds_of(quad, first_index);
        tree_.nodes[number].bounds = block.bounds;
        tree_.nodes[number].block = static_cast<std::int16_t>(tree_.blocks.size());
        const int covered = 1 << (tree_.hyper_level - quad.depth);
        for (int row = quad.row * covered; row < (quad.row + 1) * covered; ++row) {
            for (int column = quad.column * covered; column < (quad.column + 1) * covered; ++column)
                tree_.block_at[static_cast<std::size_t>(row * tree_.side() + column)] =
                    static_cast<std::uint8_t>(tree_.blocks.size());
        }
        tree_.blocks.push_back(std::move(block));
    }

    /// 4.1, basic block-level construction: as many levels as there are points for.
    void make_levels(const Quad& quad, HyperBlock& block) {
        int finest = quad.depth;
        while (finest + 1 < kQuadLevels && quad.has_points_of(finest + 1, points_)) ++finest;
        for (int level = quad.depth; level <= finest; ++level) block.add_level(make_level(quad, level));
    }

    /// 4.1, extended block-level construction.
    [[nodiscard]] InfoLevel make_level(const Quad& quad, int level) {
        InfoLevel result;
        std::array<VertexSet, 4> extensions;
        for (const Edge edge : kEdges) {
            extensions[index(edge)] = quad.extension(edge, level + 1, points_);
            if (extensions[index(edge)].any())
                result.extendable = static_cast<BorderType>(result.extendable | 1U << index(edge));
        }
        result.first_strip = static_cast<std::uint16_t>(tree_.strips.size());
        tree_.strips.resize(tree_.strips.size() + (result.extendable == 0 ? 1 : kBorderTypes));
        for (unsigned type = 0; type < kBorderTypes; ++type) {
            if ((type & ~unsigned{result.extendable}) != 0) continue;
            VertexSet vertices = points_ & up_to_level(level);
            for (std::size_t edge = 0; edge < 4; ++edge)
                if ((type >> edge & 1U) != 0) vertices |= extensions[edge];
            const std::size_t first = tree_.indices.size();
            for (const TreeTriangle& root : triangles_of(quad).roots)
                triangulate(vertices, root, [&](const TreeTriangle& leaf) { add(leaf, result); });
            tree_.strips[result.first_strip + type] = range_from(first);
        }
        return result;
    }

    /// Where a branch ends early. A triangle whose corner, the middle of an edge of the quad around this one,
    /// is no point is not there; the one it would be half of is, and belongs to the block of the first half,
    /// with the whole edge.
    void make_special(const Quad& quad, HyperBlock& block) {
        InfoLevel level;
        const std::size_t first = tree_.indices.size();
        const QuadTriangles& triangles = triangles_of(quad);
        for (std::size_t i = 0; i < triangles.roots.size(); ++i) {
            const TreeTriangle &root = triangles.roots[i], &whole = triangles.wholes[i];
            const Rank apex = hierarchy_.rank_of(root.vertices[0]);
            if (apex == kNoRank || points_[apex]) {
                add(root, level);
                continue;
            }
            if (triangles.is_first_half[i]) add(whole, level);
            const std::uint8_t edge = hierarchy_.vertices()[apex].edge;
            if (edge == selective::kInside) continue;
            block.on_tile_edge[edge] = triangles.is_first_half[i] ? quad.around().posts_on(kEdges[edge]) : 0;
        }
        level.first_strip = static_cast<std::uint16_t>(tree_.strips.size());
        tree_.strips.push_back(range_from(first));
        block.add_level(level);
    }

    /// 4.1, assignment of block errors: of a triangle that is not split, what its split is judged by.
    void add(const TreeTriangle& triangle, InfoLevel& level) {
        tree_.indices.insert(tree_.indices.end(), triangle.vertices.begin(), triangle.vertices.end());
        const bool cell = triangle.middle == kNoRank;
        level.error_m =
            std::max(level.error_m, cell ? unseen_m_ + cell_arc_m_ : posts_.bound_m[triangle.middle]);
        level.arc_m = std::max(level.arc_m, cell ? cell_arc_m_ : posts_.arc_m[triangle.middle]);
    }

    [[nodiscard]] IndexRange range_from(std::size_t first) const {
        return {static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(tree_.indices.size() - first)};
    }

    /// Around the quad's posts, what is drawn of it, and the surface between.
    [[nodiscard]] Sphere bounds_of(const Quad& quad, std::size_t first_index) const {
        Sphere bounds{from_origin_m_[quad.centre()], 0.0F};
        const auto hold = [&](std::size_t post) {
            bounds.radius_m = std::max(bounds.radius_m, glm::distance(bounds.centre_m, from_origin_m_[post]));
        };
        for (int row = quad.first_row(); row <= quad.first_row() + quad.cells(); ++row) {
            for (int column = quad.first_column(); column <= quad.first_column() + quad.cells(); ++column)
                hold(static_cast<std::size_t>(row * kBlockPosts + column));
        }
        for (std::size_t i = first_index; i < tree_.indices.size(); ++i) hold(tree_.indices[i]);
        bounds.radius_m += unseen_m_;
        return bounds;
    }

    static std::size_t index(Edge edge) { return static_cast<std::size_t>(edge); }

    const DependencyHierarchy& hierarchy_ = DependencyHierarchy::of_block();
    const selective::BlockPosts& posts_;
    float unseen_m_;
    float cell_arc_m_ = 0.0F;
    const VertexSet& points_;
    std::array<glm::vec3, kBlockVertices> from_origin_m_{};
    HyperTree tree_;
};

}  // namespace

std::span<const std::uint16_t> HyperTree::strip(const HyperBlock& block, int level, BorderType border) const {
    const InfoLevel& info = block.level(level);
    const IndexRange& range = strips[info.first_strip + std::size_t{border}];
    return std::span{indices}.subspan(range.first, range.count);
}

HyperTree make_hyper_tree(const Block& tile, const selective::BlockPosts& posts, float unseen_m,
                          const PointSet& points, int hyper_level) {
    return Maker(tile, posts, unseen_m, points, hyper_level).take();
}

}  // namespace eyepoint::terrain::hyperblock
