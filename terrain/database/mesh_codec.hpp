/// A nested mesh as bytes: places, levels, targets and triangles as streams of small numbers, in one zstd
/// frame (docs/database-format.md, "Mesh"). Thread use: pure functions, from any thread.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "terrain/database/database.hpp"

namespace eyepoint::terrain {

/// Heights of fine posts become whole multiples of height_step_m. Decoding gives back everything else as it
/// is, but the triangles, which come in the order of canonical_triangles() (mesh_structure.hpp). On failure:
/// what is wrong with the mesh's structure (check_structure), without naming the tile.
[[nodiscard]] tl::expected<std::vector<std::uint8_t>, std::string> encode_mesh(const NestedMesh& mesh,
                                                                               std::uint8_t first_level,
                                                                               std::uint8_t last_level,
                                                                               double height_step_m);

/// Any bytes may be given; what comes back has passed check_structure. The levels are those it was written
/// with. On failure: the fault, without naming the file.
[[nodiscard]] tl::expected<NestedMesh, std::string> decode_mesh(std::span<const std::uint8_t> bytes,
                                                                std::uint8_t first_level,
                                                                std::uint8_t last_level,
                                                                double height_step_m);

}  // namespace eyepoint::terrain
