/// What the method bintree keeps in memory for a node of its trees (docs/methods/bintree.md).
#pragma once

#include "terrain/lod/bintree/code_set.hpp"
#include "terrain/lod/bintree/split_vertices.hpp"

namespace eyepoint::tools {

inline constexpr double kNodeSetsBytes = 2 * sizeof(terrain::bintree::CodeSet);  ///< a block: split, wanted
inline constexpr double kNodeErrorsBytes = sizeof(terrain::bintree::SplitVertices);  ///< of a block's posts

/// Of so many bytes a block, for each node that is there: a tree of n nodes is n / 2 + 1 triangles.
[[nodiscard]] constexpr double bytes_a_node(double blocks, double triangles, double block_bytes) {
    return blocks * block_bytes / (2.0 * triangles - 2.0 * blocks);
}

}  // namespace eyepoint::tools
