/// What splitting a node is worth: the vertex it adds to a block's mesh, by the errors of what would be drawn
/// without it.
#pragma once

#include <array>

#include "terrain/block/block.hpp"
#include "terrain/lod/bintree/length_bound.hpp"

namespace eyepoint::terrain::bintree {

/// Both triangles of a split and everything below them lie within the radius of its vertex and within the
/// error of the two triangles, along the vertical, at every post of the block. Nested: no vertex of a
/// descendant's split has a greater error, or a ball that is not inside this one. So of two splits one of
/// which stands on the other, inside a block, the lower one is never wanted alone.
struct SplitVertex {
    LengthBound error;
    LengthBound radius;
};
static_assert(sizeof(SplitVertex) == 4);

/// By grid vertex. Corners of the block are no split's: error and radius 0.
using SplitVertices = std::array<SplitVertex, kBlockVertices>;

/// Deviations are true ones, of every post from every triangle; the block must be a grid's.
[[nodiscard]] SplitVertices split_vertices(const Block& block);

}  // namespace eyepoint::terrain::bintree
