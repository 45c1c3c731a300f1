/// HyperBlock-QuadTIN: triangulations of blocks made ahead, chosen by block; and QuadTIN, by vertex, to
/// compare it with. docs/methods/hyperblock.md.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "terrain/lod/hyperblock/hyperblock_options.hpp"
#include "terrain/lod/hyperblock/level_adjustment.hpp"
#include "terrain/lod/hyperblock/point_set.hpp"
#include "terrain/lod/hyperblock/vertex_selection.hpp"
#include "terrain/lod/lod_method.hpp"
#include "terrain/lod/selective/dike.hpp"
#include "terrain/lod/tile_cut.hpp"
#include "terrain/lod/twist.hpp"

namespace eyepoint::terrain {

/// What is prepared when a tile is drawn for the first time (4.1): its irregular point set and, of that, the
/// hyper-blocks with all their triangulations. A frame, in the paper's order (4.3):
/// 1. The tiles in the view volume: a cut through the quadtree, made so that all points of a tile's set keep
///    to the tolerance.
/// 2. Hyper-blocks in the view volume, and basic levels.
/// 3. Level adjustment, and border types.
/// 4. Where a tile's choices have changed, its list is put together from the ready ones and sent.
/// 5. Dikes between tiles, whose point sets were made apart (terrain/lod/selective/dike.hpp).
/// By vertex, 2 to 4 are one: every tile's triangles are made anew in every frame, and sent if others.
/// Nothing is kept from frame to frame that a still eye could see; the slack is not used.
class HyperblockLod final : public LodMethod {
  public:
    explicit HyperblockLod(const hyperblock::Options& options = {});

    [[nodiscard]] std::string_view name() const override { return "hyperblock"; }
    [[nodiscard]] MeshKind mesh_kind() const override { return MeshKind::Grid; }
    [[nodiscard]] std::span<const std::uint16_t> indices() const override { return {}; }
    [[nodiscard]] const Selection& select(const LodView& view, TileTree& tree, std::uint64_t frame) override;

    /// Of the last selection: hyper-blocks in the view volume (0 by vertex), and triangles that stand upright
    /// between tiles.
    [[nodiscard]] std::uint64_t hyper_blocks() const;
    [[nodiscard]] std::uint64_t dike_triangles() const;

  private:
    /// A tile that is drawn, or was not long ago.
    struct Held {
        TileNode* node = nullptr;
        std::uint64_t used_frame = 0;
        Ecef origin{0.0};
        hyperblock::PointSet points;
        hyperblock::TileBlocks blocks;                     ///< by block
        std::vector<hyperblock::BlockChoice> in_mesh;      ///< the choices that the mesh was made of
        std::unique_ptr<hyperblock::NestedPoints> nested;  ///< by vertex
        std::size_t own_indices = 0;                       ///< of the mesh's; then come those of dikes
        selective::FarSides far_sides{};                   ///< of the dikes in the mesh
        bool changed = false;                              ///< other triangles than in the frame before
        BlockMesh mesh;
    };

    [[nodiscard]] double excess_m(const TileNode& node);
    void collect(std::uint64_t frame);
    void link_neighbours();
    [[nodiscard]] std::unique_ptr<Held> hold(TileNode& node);
    void select_by_block(const LodView& view);
    void put_together(Held& tile);
    void select_by_vertex(const LodView& view);
    void make_dikes();
    void emit();

    hyperblock::Options options_;
    Twists twists_;
    TileCut cut_;
    std::unordered_map<TileId, std::unique_ptr<Held>, TileHash> tiles_;
    std::vector<Held*> drawn_;  ///< near to far; a leaf's LodMark::draw is its place
    std::vector<hyperblock::TileBlocks*> drawn_blocks_;
    hyperblock::LevelAdjustment adjustment_;
    std::vector<std::uint16_t> made_;  ///< by vertex: a tile's triangles
    std::uint64_t version_ = 0;
    Selection selection_;
};

}  // namespace eyepoint::terrain
