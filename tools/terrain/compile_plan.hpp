/// Which tiles a database will have, known before any is made: the tree under the two roots.
#pragma once

#include <cstdint>
#include <functional>
#include <unordered_set>

#include "terrain/tiling/tile_id.hpp"
#include "tools/terrain/surface_source.hpp"

namespace eyepoint::tools {

/// The tree of tiles: a tile's four children are there all or none; depths 0 and 1 are always there.
class TilePlan {
  public:
    /// Children are made where a source has detail in any of the four. Ends early, incomplete, when
    /// cancelled.
    TilePlan(const ElevationSource& elevation, const ImagerySource* imagery,
             const std::function<bool()>& cancelled);

    [[nodiscard]] bool has_children(terrain::TileId tile) const { return split_.contains(tile); }
    [[nodiscard]] bool contains(terrain::TileId tile) const {
        return tile.depth == 0 || has_children(terrain::parent(tile));
    }
    [[nodiscard]] std::uint64_t tiles() const { return 2 + 4 * split_.size(); }
    [[nodiscard]] std::uint32_t max_depth() const { return max_depth_; }
    /// Bounds of the tiles of the greatest depth.
    [[nodiscard]] terrain::GeographicExtent deepest_extent() const;

  private:
    std::unordered_set<terrain::TileId, terrain::TileHash> split_;
    std::uint32_t max_depth_ = 0;
};

}  // namespace eyepoint::tools
