/// What of HyperBlock-QuadTIN can be chosen.
#pragma once

#include <cstdint>

namespace eyepoint::terrain::hyperblock {

/// What is selected in a frame.
enum class SelectBy : std::uint8_t {
    Block,  ///< HyperBlock: one of the triangulations made ahead for a hyper-block (section 4.3)
    Vertex  ///< QuadTIN, which it is compared with: vertex by vertex, triangles made anew (section 3)
};

/// Blocks of at least 4 x 4 cells.
inline constexpr int kMostHyperLevel = 3;

struct Options {
    SelectBy select_by = SelectBy::Block;
    /// Depth below a tile at which hyper-blocks hang: a tile has 4^hyper_level. 0..kMostHyperLevel.
    int hyper_level = 2;
    /// Which tiles are drawn is chosen for this tolerance, pixels, if that is less than the view's. 0: for
    /// the view's. A fixed one makes the blocks the same at all tolerances, as the paper's are.
    double blocks_tau_px = 0.0;
};

}  // namespace eyepoint::terrain::hyperblock
