/// The method of Larsen & Christensen: tiles of equal grids, levels that differ by a factor of four, and a
/// morph between them in the vertex shader. docs/methods/tile.md.
#pragma once

#include <memory>
#include <unordered_map>
#include <vector>

#include "terrain/lod/lod_method.hpp"
#include "terrain/lod/tile/level_switch.hpp"
#include "terrain/lod/tile/tile_mesh.hpp"
#include "terrain/lod/tile/tiled_block.hpp"
#include "terrain/lod/tile_cut.hpp"

namespace eyepoint::terrain {

/// A frame:
/// 1. Blocks (terrain/lod/tile_cut.hpp). A block gives way to its parent only when its tiles are drawn as the
///    parent would draw them, and takes over from it in the same way: so that nobody sees it.
/// 2. Levels. Each tile wants its coarsest level whose error is within the tolerance; a neighbour more than
///    one level coarser wants a finer one.
/// 3. Morph. Slides that are under way go on by the clock; tiles that want another level begin one, or end
///    it, a few a frame. What comes into view, and after a jump of the eye, is drawn as it is wanted.
/// 4. Stitching and the slide of each half edge, by the two tiles beside it.
/// Without morph, tiles are drawn as wanted: the meshes are a function of the view. The slack is not used.
class TileLod final : public LodMethod {
  public:
    explicit TileLod(const tiles::Options& options = {});
    TileLod(const TileLod&) = delete;
    TileLod& operator=(const TileLod&) = delete;

    [[nodiscard]] std::string_view name() const override { return "tile"; }
    [[nodiscard]] MeshKind mesh_kind() const override { return MeshKind::Grid; }
    [[nodiscard]] std::span<const std::uint16_t> indices() const override { return meshes_.indices(); }
    [[nodiscard]] int sliding_parts() const override { return options_.morph ? division_.parts : 0; }
    [[nodiscard]] const Selection& select(const LodView& view, TileTree& tree, std::uint64_t frame) override;

    /// Of the last selection: tiles that changed to another level's mesh by way of the queue.
    [[nodiscard]] std::uint32_t switched() const { return switched_; }
    /// Of the last selection: tiles under way between two levels, or waiting to be.
    [[nodiscard]] std::size_t unsettled() const;

  private:
    [[nodiscard]] tiles::TiledBlock& block_of(TileNode& node);
    /// Of a tile of the last frame, or nullptr where its block was not drawn.
    [[nodiscard]] const tiles::Tile* drawn_before(const TileNode& node, TileId place) const;
    [[nodiscard]] tiles::Tile* tile_in(tiles::TiledBlock& block, TileId place) const;
    /// nullptr where it is not drawn in this frame.
    [[nodiscard]] tiles::Tile* drawn_tile(const TileNode& node, TileId place) const;

    [[nodiscard]] bool keeps(const TileNode& node) const;
    [[nodiscard]] bool can_take_over(const TileNode& node, TileId place) const;
    void collect(const LodView& view);
    void begin(tiles::TiledBlock& block, const LodView& view);
    void link();
    [[nodiscard]] std::array<tiles::Tile*, 2> across(const tiles::Tile& tile, Edge edge) const;
    void want(const LodView& view);
    [[nodiscard]] int resolution_wanted(const tiles::Tile& tile, double distance, double tau_px) const;
    void want_as_parent(tiles::Tile& tile, const LodView& view);
    void balance_wanted();
    void morph();
    void take_up(tiles::Tile& tile) const;
    void settle();
    void emit();
    void drop_unused();

    tiles::Options options_;
    tiles::Division division_;
    tiles::TileMeshes meshes_;
    TileCut cut_;
    tiles::SlideClock clock_;
    tiles::SwitchQueue queue_;
    std::unordered_map<TileId, std::unique_ptr<tiles::TiledBlock>, TileHash> blocks_;
    std::vector<tiles::TiledBlock*> drawn_;  ///< near to far; a leaf's LodMark::draw is its place
    std::vector<tiles::Tile*> tiles_;        ///< of the drawn blocks
    std::vector<std::vector<tiles::Tile*>> by_resolution_;  ///< to balance, finest first
    std::uint64_t frame_ = 0;
    std::uint32_t switched_ = 0;
    Selection selection_;
};

}  // namespace eyepoint::terrain
