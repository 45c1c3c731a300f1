/// What every nested mesh must be for its readers to rely on it (database.hpp, NestedMesh).
/// Thread use: pure functions, from any thread.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "terrain/database/database.hpp"

namespace eyepoint::terrain {

/// Checks: at most 33 x 33 vertices; posts and fine posts rising, in the tile, no fine post at an own post;
/// the four corner posts there, and staying; levels to last_level, or kStays; a
/// vertex that goes has a target that goes later or stays, one that stays has target 0; triangles with three
/// different corners that are vertices. Not checked: that the triangles cover the tile once (check_cover). On
/// failure: the fault, without naming the tile.
[[nodiscard]] tl::expected<void, std::string> check_structure(const NestedMesh& mesh,
                                                              std::uint8_t last_level);

/// Whether the triangles of a mesh of sound structure, seen from above, cover the tile once: all
/// counterclockwise or flat (but for those at a corner of the tile, which may have slid elsewhere), every
/// inner edge between two of them, every other edge on the tile's border, and their areas add up. On failure:
/// the fault.
[[nodiscard]] tl::expected<void, std::string> check_cover(const NestedMesh& mesh);

/// The triangles in the order that the codec gives them back: each from its smallest vertex on, rising.
[[nodiscard]] std::vector<std::uint16_t> canonical_triangles(const NestedMesh& mesh);

}  // namespace eyepoint::terrain
