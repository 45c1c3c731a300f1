/// What a block's triangles err by because cells are split the other way than delta has them.
#pragma once

#include <unordered_map>

#include "terrain/database/database.hpp"
#include "terrain/pager/tile_tree.hpp"

namespace eyepoint::terrain {

/// Greatest distance, along the vertical, between a block with all its posts whose cells are split every
/// other way, as bintrees and fans of right triangles have it, and one that is split as NodeInfo::delta_m has
/// it; metres.
[[nodiscard]] float twist_m(const BlockData& data);

/// The twists of tiles, each worked out when it is first asked for. Thread use: one thread.
class Twists {
  public:
    /// Of a tile whose block is loaded; metres. 0 for tiles without children: nothing is drawn finer than
    /// they are, so their posts are the surface itself.
    [[nodiscard]] float of_m(const TileNode& node);

  private:
    std::unordered_map<TileId, float, TileHash> known_m_;
};

}  // namespace eyepoint::terrain
