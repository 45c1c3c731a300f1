/// Regular block levels: every tile's block drawn with every 2^l-th post, l by its error in pixels; quadtree
/// and levels kept within one step between neighbours, edges thinned to match.
#pragma once

#include <array>
#include <vector>

#include "terrain/lod/lod_method.hpp"
#include "terrain/lod/regular_mesh.hpp"

namespace eyepoint::terrain {

/// How it chooses, in four passes:
/// 1. Cut. From the roots down, a visible tile is split when its finest level is too coarse for the view:
///    kappa * delta_0 / D > tau, or when its picture's texels cover more than two pixels and there are finer
///    pictures below. A split needs the four children loaded (else they are wished for and the tile is drawn
///    in their place), and no edge neighbour that is drawn and less deep (else that is split first): so
///    neighbours in the cut differ by one depth at most.
/// 2. Levels. Each visible tile takes its coarsest level with kappa * delta_l / D <= tau.
/// 3. Balance. A tile's resolution is depth + 5 - level; a visible neighbour more than one below it is
/// raised.
/// 4. Edges. Where a neighbour is one resolution coarser, the half edge towards it is thinned by one.
/// Tiles outside the view or hidden by the curve of the Earth are not drawn and set no conditions: an edge
/// shared with them is not seen.
class RegularLod final : public LodMethod {
  public:
    [[nodiscard]] std::string_view name() const override { return "regular"; }
    [[nodiscard]] MeshKind mesh_kind() const override { return MeshKind::Grid; }
    [[nodiscard]] std::span<const std::uint16_t> indices() const override { return meshes_.indices(); }
    [[nodiscard]] const Selection& select(const LodView& view, TileTree& tree, std::uint64_t frame) override;

  private:
    struct Frame;

    void cut(Frame& frame);
    void visit(Frame& frame, TileNode& node);
    [[nodiscard]] bool split(Frame& frame, TileNode& node);
    [[nodiscard]] bool have_children(const Frame& frame, TileNode& node, double priority);
    void keep_ready(const Frame& frame, TileId tile, double priority);
    void choose_levels(Frame& frame);
    void balance(Frame& frame);
    void emit(Frame& frame);

    RegularMeshes meshes_;
    Selection selection_;
    std::vector<std::vector<TileNode*>> by_depth_;       ///< tiles to visit, coarsest first
    std::vector<TileNode*> leaves_;                      ///< the visible leaves of the cut
    std::vector<std::vector<TileNode*>> by_resolution_;  ///< leaves to balance, finest first
};

}  // namespace eyepoint::terrain
