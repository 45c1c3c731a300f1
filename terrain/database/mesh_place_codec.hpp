/// Posts and fine posts of a nested mesh as bytes (docs/database-format.md, "Mesh").
/// Thread use: pure functions, from any thread.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "terrain/database/byte_stream.hpp"
#include "terrain/database/database.hpp"

namespace eyepoint::terrain {

/// The mesh is of sound structure (check_structure).
[[nodiscard]] std::vector<std::uint8_t> encode_places(const NestedMesh& mesh, double height_step_m);

struct DecodedPlaces {
    std::vector<std::uint16_t> posts;
    std::vector<NestedMesh::FinePost> fine_posts;
};
/// Reads what encode_places wrote. At most 33 x 33 vertices, all in the tile, in order; the rest is not
/// checked. On failure: the fault.
[[nodiscard]] tl::expected<DecodedPlaces, std::string> decode_places(ByteReader& bytes, double height_step_m);

}  // namespace eyepoint::terrain
