/// Draws the blocks of a selection cell by cell: each cell with the coarsest list that its own distance
/// allows, and none of those beside the view.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "terrain/block/cell_boxes.hpp"
#include "terrain/lod/cell_tests.hpp"
#include "terrain/lod/lod_method.hpp"

namespace eyepoint::terrain {

/// A list of level k may draw a cell where every vertex that the list leaves out of the cell's triangles has
/// gone: where lambda >= k at all that go by then (nested_motion.hpp). They are in the cell's box for level
/// k - 1 (CellBoxes), so its distance decides. A triangle keeps its cell through all levels, so cells of any
/// levels meet. A cell is beside the view when the box for a level that is nowhere exceeded in it is wholly
/// outside one side, and farther than tau + s: so that the full-resolution surface in view has the drawn one
/// over it. No pixel changes by it.
///
/// A block wholly in view with one level near and far costs two comparisons. Thread use: one thread.
/// Allocates only while its scratch space grows.
class CellCut {
  public:
    /// selection: one draw a block, the whole of a list that is right for it, floors known. sides: by draw,
    /// bit n: side n of the view may cut the block. Draws come back in the same order, a block's cells in as
    /// few draws as they have runs of one level; short gaps between runs are drawn. A block of which nothing
    /// is in view has none.
    [[nodiscard]] Selection cut(const LodView& view, std::span<const std::uint8_t> sides,
                                Selection selection);

  private:
    struct Frame;
    struct LocalView;
    void cut_block(const Frame& frame, const BlockDraw& draw, unsigned sides, Selection& selection);
    static CellSet allowing(const Frame& frame, const LocalView& local, int level);
    static CellSet find_outside(const Frame& frame, const LocalView& local, const BlockDraw& draw,
                                unsigned sides);
    void keep(const BlockDraw& draw, std::uint8_t level, CellSet cells, CellSet barred, CellSet in_view,
              Selection& selection);

    std::vector<BlockDraw> kept_;
};

}  // namespace eyepoint::terrain
