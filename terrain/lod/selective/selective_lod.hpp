/// The method of Ueng & Chuang: vertices selected block by block, each block by itself and kept as long as it
/// stands, and dikes between blocks. docs/methods/selective.md.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "terrain/lod/lod_method.hpp"
#include "terrain/lod/selective/block_posts.hpp"
#include "terrain/lod/selective/block_selection.hpp"
#include "terrain/lod/selective/dike.hpp"
#include "terrain/lod/selective/lod_cache.hpp"
#include "terrain/lod/selective/selective_options.hpp"
#include "terrain/lod/tile_cut.hpp"
#include "terrain/lod/twist.hpp"

namespace eyepoint::terrain {

/// What is in the drawn blocks' meshes, against what a view asks for (paper, table 3).
struct SelectionAudit {
    std::uint64_t selected = 0;  ///< vertices
    std::uint64_t missed = 0;    ///< not selected though their error is above tau
    std::uint64_t too_far = 0;   ///< of them: above tau + s
    double worst_px = 0.0;       ///< greatest error of a vertex that is left out
    std::uint64_t dike_triangles = 0;

    void merge(const SelectionAudit& other);
};

/// A frame, in the paper's order (3.1):
/// 1. The blocks in the view volume: a cut through the quadtree, made so that a block's full resolution uses
///    half of the tolerance.
/// 2. For each, whether its selection can be used again; else a new one.
/// 3. Dikes.
/// Blocks that leave the view keep their selection for a while.
class SelectiveLod final : public LodMethod {
  public:
    explicit SelectiveLod(const selective::Options& options = {})
        : options_(options), cut_([this](const TileNode& node) { return twists_.of_m(node); }) {}

    [[nodiscard]] std::string_view name() const override { return "selective"; }
    [[nodiscard]] MeshKind mesh_kind() const override { return MeshKind::Grid; }
    [[nodiscard]] std::span<const std::uint16_t> indices() const override { return {}; }
    [[nodiscard]] const Selection& select(const LodView& view, TileTree& tree, std::uint64_t frame) override;

    /// Of the last selection, by the screen error in force.
    [[nodiscard]] SelectionAudit audit(const LodView& view) const;

  private:
    struct Held {
        TileNode* node = nullptr;
        std::uint64_t used_frame = 0;
        selective::BlockPosts posts;
        std::array<Ecef, 4> corners{};
        selective::BlockSelection selection;
        selective::SelectedFor selected_for;
        std::size_t own_indices = 0;      ///< of the mesh's; then come those of dikes
        selective::FarSides far_sides{};  ///< of the dikes in the mesh
        bool changed = false;             ///< selected anew in this frame
        BlockMesh mesh;
    };

    void collect(std::uint64_t frame);
    void drop_unused(std::uint64_t frame);
    [[nodiscard]] std::unique_ptr<Held> hold(TileNode& node);
    void select_vertices(const LodView& view);
    [[nodiscard]] bool stands(const Held& block, const LodView& view) const;
    void select_anew(Held& block, const LodView& view);
    void make_dikes();
    [[nodiscard]] const Held& held(const TileNode& leaf) const { return *drawn_[leaf.mark.draw]; }
    void emit();

    selective::Options options_;
    Twists twists_;
    TileCut cut_;
    std::unordered_map<TileId, std::unique_ptr<Held>, TileHash> blocks_;
    std::vector<Held*> drawn_;  ///< near to far; a leaf's LodMark::draw is its place
    selective::TestedPosts tested_;
    Ecef eye_{0.0};
    double odometer_m_ = 0.0;  ///< the eye's path
    std::uint64_t version_ = 0;
    Selection selection_;
};

}  // namespace eyepoint::terrain
