/// The method of He, Wang & Liu: a right-triangle bintree a block, by codes, split and merged from frame to
/// frame. docs/methods/bintree.md.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "terrain/lod/bintree/forest.hpp"
#include "terrain/lod/bintree/split_vertices.hpp"
#include "terrain/lod/lod_method.hpp"
#include "terrain/lod/tile_cut.hpp"

namespace eyepoint::terrain {

/// A frame, in the paper's order:
/// 1. Paging (3.1). Which blocks are in the mesh follows from a cut through the quadtree, made so that a
///    block's full resolution uses half of the tolerance.
/// 2. Conjunction (3.2). A block that has come is subdivided along its borders until it meets its neighbours.
/// 3. Refinement (2.4). A node is wanted while its error is above the tolerance, kappa * E > tau * D; wanted
///    nodes are split, their base neighbours first.
/// 4. Simplification (2.4). Splits that are not wanted, and on which nothing stands, are merged.
/// The mesh is the smallest without T-junctions that has all wanted splits (and can have: between depths
/// forest.hpp), so it is a function of the view and the blocks there are, not of the way there.
/// The slack is not used.
///
/// With a triangle budget the tolerance in force is the least one, and at least the view's, at which the mesh
/// has no more triangles than that, to a few percent; it is looked for from the last frame's. More are drawn
/// only where the blocks themselves, two triangles each, are more.
class BintreeLod final : public LodMethod {
  public:
    /// 0: no budget.
    explicit BintreeLod(std::uint32_t triangle_budget = 0) : triangle_budget_(triangle_budget) {}

    [[nodiscard]] std::string_view name() const override { return "bintree"; }
    [[nodiscard]] MeshKind mesh_kind() const override { return MeshKind::Grid; }
    [[nodiscard]] std::span<const std::uint16_t> indices() const override { return {}; }
    [[nodiscard]] const Selection& select(const LodView& view, TileTree& tree, std::uint64_t frame) override;

  private:
    /// What the method keeps of a block in the mesh, beside its tree.
    struct Active {
        const TileNode* node = nullptr;
        std::uint64_t seen_frame = 0;
        std::uint64_t entered_frame = 0;
        bintree::SplitVertices vertices;
        bintree::CodeSet wanted;
        double judge_again_m = 0.0;  ///< odometer up to which `wanted` stands
        bool check_splits = false;   ///< some may not be needed any more
        BlockMesh mesh;
    };
    struct Judgement {
        bintree::CodeSet wanted;
        double margin_m = 0.0;  ///< the eye may move so far before any node is judged otherwise
    };

    [[nodiscard]] bool enter_and_leave(std::uint64_t frame);
    [[nodiscard]] bintree::Across across(const TileNode& node, Edge edge) const;
    [[nodiscard]] bool is_new(const bintree::Across& across, std::uint64_t frame) const;
    void conjoin(std::uint64_t frame);
    [[nodiscard]] double tolerance_of_blocks(double tau_px);
    void fit(const LodView& view);
    void shape(const LodView& view);
    void judge(const LodView& view);
    [[nodiscard]] Judgement judge(const Active& block, const LodView& view) const;
    void refine();
    void simplify();
    void simplify(bintree::BlockNumber number, int level);
    [[nodiscard]] std::uint64_t triangles() const;
    void emit();

    TileCut cut_;
    bintree::Forest forest_;
    std::unordered_map<TileId, bintree::BlockNumber, TileHash> numbers_;
    std::vector<Active> blocks_;               ///< by number
    std::vector<bintree::BlockNumber> drawn_;  ///< near to far
    std::vector<std::pair<bintree::BlockNumber, Edge>> to_conjoin_;
    std::uint32_t triangle_budget_;
    double blocks_tau_px_ = 1.0;  ///< that blocks were last chosen for
    LodView view_;                ///< that blocks were last judged for, with the tolerance in force
    double odometer_m_ = 0.0;     ///< the eye's path
    std::uint64_t version_ = 0;
    Selection selection_;
};

}  // namespace eyepoint::terrain
