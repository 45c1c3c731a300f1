/// Block levels: every tile's block drawn with every 2^l-th post, l by its error in pixels; quadtree
/// and levels kept within one step between neighbours, edges thinned to match.
#pragma once

#include <vector>

#include "terrain/lod/lod_method.hpp"
#include "terrain/lod/tile/tile_mesh.hpp"
#include "terrain/lod/tile_cut.hpp"

namespace eyepoint::terrain {

/// How it chooses:
/// 1. Cut (terrain/lod/tile_cut.hpp).
/// 2. Levels. Each visible tile takes its coarsest level with kappa * delta_l / D <= tau.
/// 3. Balance. A tile's resolution is depth + 5 - level; a visible neighbour more than one below it is
/// raised.
/// 4. Edges. Where a neighbour is one resolution coarser, the half edge towards it is thinned by one.
class TileLod final : public LodMethod {
  public:
    [[nodiscard]] std::string_view name() const override { return "tile"; }
    [[nodiscard]] MeshKind mesh_kind() const override { return MeshKind::Grid; }
    [[nodiscard]] std::span<const std::uint16_t> indices() const override { return meshes_.indices(); }
    [[nodiscard]] const Selection& select(const LodView& view, TileTree& tree, std::uint64_t frame) override;

  private:
    void choose_levels(double tau_px);
    void balance();
    void emit();

    TileMeshes meshes_;
    Selection selection_;
    TileCut cut_;
    std::vector<TileNode*> leaves_;                      ///< of the cut
    std::vector<std::vector<TileNode*>> by_resolution_;  ///< leaves to balance, finest first
};

}  // namespace eyepoint::terrain
