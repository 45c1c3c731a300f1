/// What a block's vertices are judged by: where they are, and what is lost without them.
#pragma once

#include <array>

#include <glm/vec3.hpp>

#include "terrain/block/block.hpp"
#include "terrain/lod/selective/dependency_hierarchy.hpp"

namespace eyepoint::terrain::selective {

/// By rank. Metres; positions along ECEF axes from `origin`.
struct BlockPosts {
    Ecef origin{0.0};
    glm::vec3 up{0.0F};  ///< unit, at the block's middle
    std::array<float, kRanks> x{}, y{}, z{};
    /// The paper's delta: height difference from the middle of the edge that the vertex splits (section 5,
    /// figure 5).
    std::array<float, kRanks> delta_m{};
    /// An upper bound on the distance of the full-resolution surface from the two triangles that are drawn
    /// where the vertex is left out, along the vertical: the greatest over all of the block's posts in them,
    /// and beyond that what the block leaves out and the arc of the Earth.
    std::array<float, kRanks> bound_m{};
    std::array<float, kRanks> arc_m{};     ///< of that: the arc over the triangles
    std::array<float, kRanks> radius_m{};  ///< both triangles lie so near to the vertex
};

/// block: a grid's. unseen_m: greatest distance of the full-resolution surface from
/// the block with all its vertices.
[[nodiscard]] BlockPosts block_posts(const Block& block, float unseen_m);

}  // namespace eyepoint::terrain::selective
