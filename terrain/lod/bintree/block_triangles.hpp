/// The triangles of a block of 33 x 33 posts by their codes.
#pragma once

#include <array>
#include <cstdint>

#include "terrain/block/block.hpp"
#include "terrain/lod/bintree/code.hpp"

namespace eyepoint::terrain::bintree {

/// Triangles of the finest level are half cells; they are not split.
inline constexpr int kFinestLevel = 10;
static_assert(1 << (kFinestLevel / 2) == kBlockCells);
/// Codes of all nodes, and of those that can be split, lie below these.
inline constexpr Code kCodesEnd = Code{4} << kFinestLevel;
inline constexpr Code kSplitCodesEnd = kCodesEnd / 2;

/// Numbers of a block's grid vertices (Block::vertices).
struct TriangleVertices {
    std::uint16_t apex = 0, left = 0, right = 0;
    std::uint16_t middle = 0;  ///< of the base; of no meaning at the finest level
};

/// By code; codes 0 and 1 are no triangles.
using BlockTriangles = std::array<TriangleVertices, kCodesEnd>;
/// Made on first use.
[[nodiscard]] const BlockTriangles& block_triangles(Diagonal diagonal);

}  // namespace eyepoint::terrain::bintree
