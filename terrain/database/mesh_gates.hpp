/// The triangles of a mesh as a stream of small numbers, where the places of the vertices are known.
///
/// The triangulation grows from a first triangle over gates: edges with a triangle on one side only. Of the
/// vertices that could be the third corner beyond a gate, the near ones are ranked by the angle under which
/// they see it (the Delaunay triangulation's choice has rank 0), and the rank of the right one is stored:
/// mostly 0. The idea of gates is of Gumhold and Strasser, "Real time compression of triangle mesh
/// connectivity", 1998; that known places predict the connectivity, of Gandoin and Devillers, "Progressive
/// lossless compression of arbitrary simplicial complexes", 2002. Thread use: pure functions, from any
/// thread.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "terrain/database/mesh_places.hpp"
#include "terrain/database/range_coder.hpp"

namespace eyepoint::terrain {

/// Twice what a triangulation of 33 x 33 vertices has.
inline constexpr std::size_t kMaxTriangles = 4096;

/// Any triangles, three corners each, at most kMaxTriangles. A triangulation that covers the tile has one
/// that no gate leads to, or a few; those cost some bytes each.
void encode_triangles(RangeEncoder& bytes, std::span<const Place> places,
                      std::span<const std::uint16_t> triangles);

/// The same triangles, as canonical_triangles() of mesh_structure.hpp gives them. Any bytes may be given; on
/// failure: the fault.
[[nodiscard]] tl::expected<std::vector<std::uint16_t>, std::string> decode_triangles(
    RangeDecoder& bytes, std::span<const Place> places);

}  // namespace eyepoint::terrain
