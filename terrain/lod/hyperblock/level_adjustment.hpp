/// Level adjustment of neighbours, and border types. Source: HyperBlock-QuadTIN, section 4.3, second and
/// third stage.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "terrain/lod/hyperblock/block_selection.hpp"
#include "terrain/tiling/tile_id.hpp"

namespace eyepoint::terrain::hyperblock {

/// The blocks of a drawn tile, and the tiles around it.
struct TileBlocks {
    TileId tile;
    HyperTree tree;
    std::vector<BlockChoice> choices;  ///< by block of the tree
    /// Across each edge (kEdges): the one tile there, twice, or the two of the next depth from the edge's
    /// start; nullptr where none is drawn.
    std::array<std::array<TileBlocks*, 2>, 4> across{};
    selective::BorderSelection border{};  ///< vertices in the mesh on the tile's edges
};

/// Thread use: the frame's. Keeps its working space from call to call.
class LevelAdjustment {
  public:
    /// Raises levels until adjacent blocks differ by one at most, as far as they have so many; then sets the
    /// border types: a block is extended towards neighbours that are one level finer. A level is that of the
    /// quadtree of the whole planet, so it is comparable across tiles of two depths. Blocks that are not
    /// selected set no conditions.
    void adjust(std::span<TileBlocks* const> tiles);

  private:
    /// A block of hyperLevel: its quad, row by row.
    struct Place {
        TileBlocks* tile = nullptr;
        int row = 0, column = 0;
    };

    void note(TileBlocks& tile, int row, int column);
    void raise_around(const Place& place, int level);

    std::vector<std::vector<Place>> by_level_;  ///< blocks to look at, by level of the planet's quadtree
};

}  // namespace eyepoint::terrain::hyperblock
