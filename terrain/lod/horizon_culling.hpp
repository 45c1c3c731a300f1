/// Leaves out of a selection of nested meshes the cells that nearer terrain hides.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "terrain/lod/lod_method.hpp"
#include "terrain/lod/terrain_horizon.hpp"

namespace eyepoint::terrain {

struct ProjectedTops;
struct ProjectedNodes;

/// Goes through the draws near to far: a block whose bounds (Block::bounds) are below the horizon is left
/// out, then cells of the others; what is left raises the horizon. No pixel changes by it.
///
/// Off, so that the selection comes back as it was, for a view without an upright picture (upright_view), and
/// for an eye below the surface, or so near it that the near plane could cut it. A block whose bounds are not
/// known, or are not good as far away as it is drawn, is drawn and hides nothing. Where it found nearly
/// nothing to leave out, it does not try for some frames. Thread use: one thread. Allocates only while its
/// scratch space grows.
class HorizonCulling {
  public:
    /// selection: near to far, a block's draws in a row, each of whole cells of a level's list.
    /// eye_above_ground_m: the eye is at least so high above the full-resolution surface. Draws come back in
    /// the same order, a block's visible cells in as few draws as they have runs of one level; short gaps
    /// between runs are drawn. `triangles_hidden` counts those left out because terrain hides them; cells
    /// outside the view are left out too, uncounted.
    [[nodiscard]] Selection cull(const LodView& view, double eye_above_ground_m, Selection selection);

  private:
    struct Frame;
    struct Bands;
    struct CellLists;
    struct CellSights;

    void cull_block(const Frame& frame, std::span<const BlockDraw> draws, Selection& selection);
    [[nodiscard]] CellSights look_at_cells(const CellLists& lists, const ProjectedTops& tops,
                                           const ProjectedNodes* nodes, const Bands& bands);
    [[nodiscard]] TerrainHorizon::Sight sight(const ProjectedTops& tops, std::size_t i) const;
    void keep_cells(const BlockDraw& draw, const CellLists& lists, const CellSights& cells,
                    Selection& selection);

    TerrainHorizon horizon_;
    std::vector<BlockDraw> kept_;
    int idle_frames_ = 0;  ///< still to pass without an attempt
};

}  // namespace eyepoint::terrain
