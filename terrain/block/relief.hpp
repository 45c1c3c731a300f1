/// What shading needs of the ground at a tile's own posts: how it leans, and where it is water. Meshes have
/// few vertices where the shape needs few; what is painted on them needs the posts.
#pragma once

#include <cstdint>
#include <vector>

#include "terrain/database/database.hpp"

namespace eyepoint::terrain {

/// Of a post: bits 0..11 the eastern, 12..23 the northern component of the unit normal, signed,
/// kReliefUnits to 1; bits 24..31: water, 0 or 255.
using ReliefPost = std::uint32_t;
inline constexpr double kReliefUnits = 2047.0;

/// Of the 33 x 33 posts, in row order from the south-west; from the heights on both sides of a post (the
/// apron's on the tile's edges), so tiles of one depth agree on their common edge.
[[nodiscard]] std::vector<ReliefPost> relief_of(const BlockData& data);

}  // namespace eyepoint::terrain
