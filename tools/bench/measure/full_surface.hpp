/// The full-resolution posts of a database, laid out so that a drawn mesh can be compared with them.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <tl/expected.hpp>

#include "terrain/database/database.hpp"
#include "terrain/lod/lod_method.hpp"
#include "terrain/tiling/tile_bounds.hpp"

namespace eyepoint::tools {

/// The posts of one tile without stored children, in the tile's frame: axes east, north, up at its middle.
///
/// Where a vertical line meets a drawn triangle is found in a map in which both are simple: the central
/// projection onto the tile's level plane from the point under its middle where the verticals nearly meet
/// (within a tile of 1 degree, to 6e-5 rad). A post's vertical is a point in it and a straight edge in space
/// is straight. Coordinates in it are whole multiples of unit_m, so that which triangle a post is in can be
/// told exactly.
struct PostTile {
    static constexpr int kSide = terrain::kBlockPosts;

    struct Place {
        std::int32_t u = 0;  ///< in the map, east, unit_m
        std::int32_t v = 0;  ///< north
        float x = 0.0F;      ///< in the tile's frame, metres
        float y = 0.0F;
        float z = 0.0F;
    };
    struct Span {
        std::int32_t low = 0, high = 0;  ///< unit_m
    };

    terrain::TileId tile;
    terrain::Ecef origin{0.0};  ///< of the frame
    glm::dmat3 axes{1.0};
    double centre_below_m = 0.0;  ///< the map's centre is at (0, 0, -centre_below_m)
    double unit_m = 0.0;
    /// Posts counted here: rows first_row..end_row - 1, columns 0..end_column - 1. A post that two tiles
    /// share counts in the northern and eastern one, where that is as deep; a pole, which is one post, in
    /// none.
    int first_row = 0, end_row = kSide, end_column = kSide;
    std::vector<Place> posts;                   ///< row * kSide + column
    std::array<Span, kSide> rows_v, columns_u;  ///< what each row and column of posts spans in the map

    /// A point given relative to a place, in the tile's frame.
    [[nodiscard]] glm::dvec3 in_frame(const glm::dvec3& from_place, const terrain::Ecef& place) const {
        return (from_place + (place - origin)) * axes;
    }
};

/// Lays out a tile's posts. `block` is the tile's own.
[[nodiscard]] PostTile lay_out(const terrain::BlockData& block, bool shared_north, bool shared_east);

/// What is looked at in a frame: inside the view volume, from near_m on, and not beyond `far_m`, not behind
/// the curve of the Earth (as a tile; terrain::HorizonOccluder).
struct PostView {
    terrain::LodView lod;
    double far_m = 120000.0;
};

/// Every tile without stored children, found by where it is; its posts are read when first looked at and kept
/// while the tiles kept are fewer than kMostTilesKept or looked at. Thread use: one thread (it uses others
/// itself).
class FullSurface {
  public:
    static constexpr std::size_t kMostTilesKept = 30000;

    /// A node of the database's quadtree; children are four in a row from first_child.
    struct Node {
        terrain::TileId tile;
        terrain::TileBounds bounds;
        bool bounds_known = false;
        std::int32_t parent = -1;
        std::int32_t first_child = -1;  ///< -1: the tile has no stored children
        std::uint64_t seen = 0;         ///< the last look that saw it
        std::int32_t slot = -1;         ///< of a leaf that is seen: its place in what look() returned
    };

    explicit FullSurface(std::shared_ptr<const terrain::Database> database);

    /// The tiles in view, read. On failure: one sentence.
    [[nodiscard]] tl::expected<std::vector<std::shared_ptr<const PostTile>>, std::string> look(
        const PostView& view);

    /// The quadtree as the last look() saw it; the first two are the roots.
    [[nodiscard]] std::span<const Node> nodes() const { return nodes_; }
    [[nodiscard]] bool seen(const Node& node) const { return node.seen == looks_; }
    /// The deepest node that holds a whole tile.
    [[nodiscard]] std::size_t node_of(terrain::TileId tile) const;

  private:
    void see(std::size_t node, const PostView& view, const terrain::HorizonOccluder& horizon,
             std::vector<std::size_t>& leaves);
    [[nodiscard]] tl::expected<std::shared_ptr<const PostTile>, std::string> read(terrain::TileId tile) const;
    void forget_unseen();

    std::shared_ptr<const terrain::Database> database_;
    std::vector<Node> nodes_;
    std::unordered_map<std::size_t, std::shared_ptr<const PostTile>> tiles_;  ///< by node
    std::uint64_t looks_ = 0;
    double lowest_height_m_ = 0.0;
};

}  // namespace eyepoint::tools
