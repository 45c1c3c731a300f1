/// The quadtree of tiles as far as it has been looked at: what is known of each tile, and its block once
/// loaded.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "terrain/block/block.hpp"
#include "terrain/database/database.hpp"
#include "terrain/tiling/tile_bounds.hpp"

namespace eyepoint::terrain {

/// Scratch space of the LOD method for the frame it works on; meaningless between frames.
struct LodMark {
    std::uint64_t frame = 0;
    double distance_m = 0.0;
    std::int8_t level = 0;
    bool split = false;
    bool visible = false;
    std::uint32_t draw = 0;  ///< index in Selection::draws
    bool was_split = false;  ///< in the frame before
    bool kept = false;       ///< split only because it was (TileCut::Keep)
};

struct TileNode {
    TileId tile;
    NodeInfo info;
    TileBounds bounds;
    TileNode* parent = nullptr;
    /// Side of a texel of this tile's picture, metres on the ground, where a child has a finer one; else 0.
    double texel_to_refine_m = 0.0;
    bool stored = false;                 ///< in the database; else interpolated from its parent's block
    bool unreadable = false;             ///< loading failed: its ancestor stands in for it
    std::shared_ptr<const Block> block;  ///< nullptr until loaded
    std::uint64_t used_frame = 0;        ///< the last frame that looked at it
    std::uint64_t wished_frame = 0;      ///< the last frame that asked for its block
    std::uint64_t ready_frame = 0;       ///< the last frame that could split it at once
    LodMark mark;
    std::unique_ptr<std::array<TileNode, 4>> children;  ///< nullptr until looked at
};

/// Owns the nodes; they stay where they are as long as the tree lives.
/// Below the database's leaves the tree goes on with interpolated tiles, so that the curve of the Earth is
/// followed wherever an eye goes, to kMaxInterpolatedDepths below; nested meshes only as far as bare_level
/// (terrain/lod/error_level.hpp) asks for. Thread use: one thread (the frame's).
class TileTree {
  public:
    explicit TileTree(std::shared_ptr<const Database> database, MeshKind mesh = MeshKind::Grid);

    static constexpr int kMaxInterpolatedDepths = 12;

    [[nodiscard]] std::span<TileNode, 2> roots() { return roots_; }
    /// The four children of a node, or none at the end of the tree. Makes their nodes on first sight.
    [[nodiscard]] std::span<TileNode> children(TileNode& node);
    /// The node of a tile if it has been looked at, else nullptr.
    [[nodiscard]] TileNode* find(TileId tile);
    /// Lowest ellipsoidal height of all terrain, metres.
    [[nodiscard]] double lowest_height_m() const { return lowest_height_m_; }

    /// Grows whenever a node's block comes or goes or is found unreadable: who keeps what the nodes said
    /// looks again when it has grown.
    [[nodiscard]] std::uint64_t changes() const { return changes_; }
    void note_change() { ++changes_; }

  private:
    void describe(TileNode& node, TileId tile, TileNode* parent) const;
    [[nodiscard]] bool ends_at(const TileNode& node) const;

    std::shared_ptr<const Database> database_;
    MeshKind mesh_;
    std::uint64_t changes_ = 0;
    std::array<TileNode, 2> roots_;
    double lowest_height_m_ = 0.0;
};

}  // namespace eyepoint::terrain
