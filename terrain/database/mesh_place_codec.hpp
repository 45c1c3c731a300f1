/// Posts and fine posts of a nested mesh as bytes (docs/database-format.md, "Mesh").
/// Thread use: pure functions, from any thread.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "terrain/database/database.hpp"
#include "terrain/database/range_coder.hpp"

namespace eyepoint::terrain {

/// The mesh is of sound structure (check_structure).
void encode_places(RangeEncoder& bytes, const NestedMesh& mesh, double height_step_m);

struct DecodedPlaces {
    std::vector<std::uint16_t> posts;
    std::vector<NestedMesh::FinePost> fine_posts;
};
/// Reads what encode_places wrote. From other bytes: at most 33 x 33 posts and as many fine posts, all in the
/// tile; the rest is not checked. On failure: the fault.
[[nodiscard]] tl::expected<DecodedPlaces, std::string> decode_places(RangeDecoder& bytes,
                                                                     double height_step_m);

}  // namespace eyepoint::terrain
