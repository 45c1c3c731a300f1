/// The hyper-blocks of a tile: several triangulations of each, made ahead. Source: HyperBlock-QuadTIN,
/// sections 4.1 and 4.2.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "terrain/block/block.hpp"
#include "terrain/lod/hyperblock/point_set.hpp"
#include "terrain/lod/lod_method.hpp"
#include "terrain/lod/selective/block_posts.hpp"

namespace eyepoint::terrain::hyperblock {

/// Metres; the centre along ECEF axes from BlockPosts::origin.
struct Sphere {
    glm::vec3 centre_m{0.0F};
    float radius_m = 0.0F;
};

/// Edges of a block, bit n for kEdges[n]. Of the paper's figure 9: which borders are extended.
using BorderType = std::uint8_t;
inline constexpr std::size_t kBorderTypes = 16;

/// Triangulations of one level of a block, by border type. 0: the basic configuration, all points up to the
/// level. Each bit adds those of the next level on one edge, and what they depend on.
struct InfoLevel {
    /// Greatest distance of the full-resolution surface from the triangulation, along the vertical, of all
    /// border types; the arc of the Earth included.
    float error_m = 0.0F;
    float arc_m = 0.0F;             ///< of that: the arc over the largest triangle
    std::uint16_t first_strip = 0;  ///< of the kBorderTypes, or of the one where nothing is extendable
    BorderType extendable =
        0;  ///< the edges on which the next level has points; the others' bits mean nothing
};

struct HyperBlock {
    /// Coarsest first; quadtree levels depth, depth + 1, ...
    std::array<InfoLevel, kQuadLevels> levels{};
    std::uint8_t level_count = 0;
    /// A quad without points in it: two triangles or, where an edge of the quad around it has no middle, its
    /// share of them. One level.
    bool is_special = false;
    std::uint8_t depth = 0;            ///< of its quad, below the tile
    std::uint8_t row = 0, column = 0;  ///< of its quad, among those of the depth
    Sphere bounds;
    /// Its posts on the tile's edges, as bits of selective::EdgeVertices, ends included.
    std::array<selective::EdgeVertices, 4> on_tile_edge{};

    [[nodiscard]] int finest() const { return level_count - 1; }
    [[nodiscard]] const InfoLevel& level(int number) const {
        return levels[static_cast<std::size_t>(number)];
    }
    void add_level(const InfoLevel& level) { levels[level_count++] = level; }
};

/// A node of the tree down to hyperLevel; its sphere holds all that is below it.
struct TreeNode {
    Sphere bounds;
    std::int16_t first_child = -1;  ///< of four in a row
    std::int16_t block = -1;        ///< of a node without children
};

struct HyperTree {
    int hyper_level = 0;
    std::vector<TreeNode> nodes;  ///< the root first
    std::vector<HyperBlock> blocks;
    std::vector<std::uint8_t> block_at;  ///< by quad of hyper_level, row by row: the block that covers it
    std::vector<IndexRange> strips;      ///< of all levels, in `indices`
    std::vector<std::uint16_t> indices;  ///< lists of triangles

    [[nodiscard]] int side() const { return 1 << hyper_level; }
    [[nodiscard]] std::uint8_t at(int row, int column) const {
        return block_at[static_cast<std::size_t>(row * side() + column)];
    }
    /// border: bits of extendable ones only.
    [[nodiscard]] std::span<const std::uint16_t> strip(const HyperBlock& block, int level,
                                                       BorderType border) const;
};

/// unseen_m: greatest distance of the full-resolution surface from the tile with all its posts, which `posts`
/// were made with.
[[nodiscard]] HyperTree make_hyper_tree(const Block& tile, const selective::BlockPosts& posts, float unseen_m,
                                        const PointSet& points, int hyper_level);

}  // namespace eyepoint::terrain::hyperblock
