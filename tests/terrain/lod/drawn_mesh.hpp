/// The union of all drawn triangles on a lattice of exact post numbers, and its gaps.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "terrain/lod/lod_method.hpp"

namespace eyepoint::testing {

/// Faults of a drawn mesh: edges that are neither shared by exactly two triangles with bit-equal end points
/// nor on the border towards a tile that is not drawn; triangles that are folded over.
struct MeshFaults {
    std::size_t edges = 0;         ///< looked at
    std::size_t cracks = 0;        ///< an inner edge with one triangle
    std::size_t overlaps = 0;      ///< an edge with more than two
    std::size_t unequal_bits = 0;  ///< the same post with different vertices in two blocks
    std::size_t folded = 0;        ///< triangles clockwise or empty on the latitude-longitude plane
};
[[nodiscard]] MeshFaults find_faults(std::span<const terrain::BlockDraw> draws,
                                     std::span<const std::uint16_t> indices);

}  // namespace eyepoint::testing
