/// The meshes of a tile: every 2^l-th post in right triangles, with any of its half edges stitched to a
/// neighbour one level coarser. Source: Larsen & Christensen, sections 2 and 2.2, figures 2 and 4.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "terrain/lod/lod_method.hpp"
#include "terrain/tiling/tile_id.hpp"

namespace eyepoint::terrain::tiles {

/// How a block's cells are divided into tiles: `parts` x `parts` of them, row by row from the south-west.
struct Division {
    int parts = 1;   ///< tiles a side
    int cells = 32;  ///< of a tile, a side: 2^w
    int levels = 5;  ///< 0..w - 1: with two cells a side at least, a tile's mesh is whole fans
};
/// posts: of a tile, a side: 9, 17 or 33.
[[nodiscard]] constexpr Division division(int posts) {
    Division result{kBlockCells / (posts - 1), posts - 1, 0};
    for (int cells = posts - 1; cells > 1; cells /= 2) ++result.levels;
    return result;
}
inline constexpr std::size_t kMostLevels = 5;

/// A set of a tile's half edges is one byte: bit 2 * edge (kEdges) for the half nearer the edge's start
/// (south or west), the next for the other.
inline constexpr int kHalfEdgeSets = 256;

/// Every mesh of every tile of a block, in one index list.
/// Two cells by two are a fan of eight right triangles around the post in the middle. A stitched half edge
/// lacks every second post of its level: of the fans along it, the two triangles at the edge are one of twice
/// the size (figure 4). No T-junctions, nothing folds.
class TileMeshes {
  public:
    explicit TileMeshes(const Division& division);
    [[nodiscard]] std::span<const std::uint16_t> indices() const { return indices_; }
    [[nodiscard]] IndexRange range(int part, int level, std::uint8_t stitched) const {
        return ranges_[static_cast<std::size_t>((part * levels_ + level) * kHalfEdgeSets + stitched)];
    }

  private:
    int levels_;
    std::vector<std::uint16_t> indices_;
    std::vector<IndexRange> ranges_;
};

}  // namespace eyepoint::terrain::tiles
