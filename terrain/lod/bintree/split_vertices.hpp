/// What splitting a node is worth: the vertex it adds to a block's mesh, by the errors of what would be drawn
/// without it.
#pragma once

#include <vector>

#include <glm/vec3.hpp>

#include "terrain/block/block.hpp"
#include "terrain/lod/bintree/code.hpp"

namespace eyepoint::terrain::bintree {

/// Both triangles of a split and everything below them lie within radius_m of its vertex and within error_m
/// of the two triangles, along the vertical, at every post of the block. Nested: no vertex of a descendant's
/// split has a greater error, or a ball that is not inside this one. So of two splits one of which stands on
/// the other, inside a block, the lower one is never wanted alone.
struct SplitVertex {
    glm::vec3 from_origin_m{0.0F};  ///< ECEF axes, from SplitVertices::origin
    float error_m = 0.0F;
    float radius_m = 0.0F;
};

struct SplitVertices {
    Ecef origin{0.0};
    /// By grid vertex. Corners of the block are no split's: error and radius 0.
    std::vector<SplitVertex> vertices;
};

/// Deviations are true ones, of every post from every triangle; the block must be a grid's.
[[nodiscard]] SplitVertices split_vertices(const Block& block);

/// Height of the Earth's arc over the base of a triangle of a level, at the equator where it is greatest,
/// metres: what the triangle errs by on a bare Earth.
[[nodiscard]] double arc_height_m(std::uint32_t depth, int level);

}  // namespace eyepoint::terrain::bintree
