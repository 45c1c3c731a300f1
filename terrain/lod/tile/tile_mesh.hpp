/// The meshes of a tile: every 2^l-th post, with any of its half edges thinned to meet a coarser
/// neighbour.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "terrain/lod/lod_method.hpp"

namespace eyepoint::terrain {

/// Levels 0..3: posts every 1, 2, 4, 8. Coarser meshes come from coarser tiles; and with at least four cells
/// a side, the middle of an edge is a post of the thinned edge too, so its halves can differ.
inline constexpr int kTileLevels = 4;

/// The halves of a block's edges; west and east from the south, south and north from the west. A set of them
/// is one byte, bit n for half n.
enum class HalfEdge : std::uint8_t {
    WestSouth,
    WestNorth,
    EastSouth,
    EastNorth,
    SouthWest,
    SouthEast,
    NorthWest,
    NorthEast
};
inline constexpr int kHalfEdgeSets = 256;

/// Every mesh of every level and thinned set, in one index list.
/// A thinned half drops every second post of its level: each dropped post's corners move along the edge to
/// the post before it, which leaves no gap and no T-junction and folds nothing.
class TileMeshes {
  public:
    TileMeshes();
    [[nodiscard]] std::span<const std::uint16_t> indices() const { return indices_; }
    [[nodiscard]] IndexRange range(int level, std::uint8_t thinned) const {
        return ranges_[static_cast<std::size_t>(level * kHalfEdgeSets + thinned)];
    }

  private:
    std::vector<std::uint16_t> indices_;
    std::array<IndexRange, kTileLevels * kHalfEdgeSets> ranges_{};
};

}  // namespace eyepoint::terrain
