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

namespace eyepoint::terrain {

struct TriangleStream {
    /// By gate: 0 where no triangle is beyond it, or 1 + the rank of the third corner. Those after the last
    /// triangle are left out.
    std::vector<std::uint8_t> gates;
    /// The three corners of each triangle that no gate leads to: the first, and what is odd.
    std::vector<std::uint16_t> seeds;
};

/// Any triangles, three corners each, at most 65535; a triangulation that covers the tile takes one seed or a
/// few.
[[nodiscard]] TriangleStream encode_triangles(std::span<const Place> places,
                                              std::span<const std::uint16_t> triangles);

/// The same triangles, as canonical_triangles() of mesh_structure.hpp gives them, if the stream is
/// encode_triangles'. Any bytes may be given; on failure: the fault.
[[nodiscard]] tl::expected<std::vector<std::uint16_t>, std::string> decode_triangles(
    std::span<const Place> places, std::size_t triangles, std::span<const std::uint8_t> gates,
    std::span<const std::uint16_t> seeds);

}  // namespace eyepoint::terrain
