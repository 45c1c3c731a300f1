/// Where a vertex of a nested mesh is drawn, as a function of the vertex, the eye and the tolerance alone:
/// the vertex shader's computation (ig/render/shaders/nested.glsl), on the CPU, for tests, measures and
/// bounds.
#pragma once

#include <cstdint>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "terrain/block/block.hpp"
#include "terrain/lod/lod_method.hpp"
#include "terrain/pager/tile_tree.hpp"

namespace eyepoint::terrain {

/// A level between meshes, lambda, is asked for at every vertex by its own distance (error_level.hpp,
/// level_at). A vertex that goes at level d is drawn
///   P(v) = (1 - t) v + t P(target(v)),  t = clamp(lambda(v) - (d - 1), 0, 1),
/// where a vertex that stays has the target and the level it has in the parent's block. So the drawn surface
/// depends on the eye, not on which blocks and levels draw it: any level k of a block is right where lambda
/// >= k at all its vertices, neighbours of any two levels or depths meet, and a change of level or depth
/// changes no picture.
///
/// Floors. A vertex on an edge of the drawn tile is drawn with lambda not below the floor of its half of the
/// edge (a vertex in the middle or at a corner: the highest it is on). On its way from target to target the
/// floor stays: the chain runs along the edge's line, which the block across it shares even where the line
/// leaves the drawn tile.
struct MotionView {
    SplitPosition eye;
    float level_scale_squared = 0.0F;  ///< of level_scale(tau + slack, kappa)
    bool morph = true;                 ///< false: lambda is rounded down, vertices jump
};
[[nodiscard]] MotionView motion_view(const LodView& view, bool morph = true);

/// Lambda as it is computed in float differs from level_at() by less than this many levels, for eyes up to
/// 1e9 m away: 1e-5 from the position's rounding at a metre's distance and from the logarithm, and a
/// hundredfold reserve. A block is drawn with the list of level k only where lambda >= k + kLevelMargin, so
/// that what the list leaves out has arrived to the bit.
inline constexpr double kLevelMargin = 1e-3;

struct DrawnVertex {
    glm::vec3 from_eye{0.0F};  ///< ECEF axes, metres
    glm::vec2 place{0.0F};     ///< in the drawn tile, 0..1; outside it where it slid to a vertex beyond
};

/// Ancestors' blocks must be loaded, as they are for every node of a selection. Equal arguments give equal
/// bits, and so do the same vertex from two blocks, and a vertex that has gone and its target. Walks at most
/// the tree's depth of ancestors.
[[nodiscard]] DrawnVertex drawn_vertex(const TileNode& node, std::uint16_t vertex, const EdgeFloors& floors,
                                       const MotionView& view);

}  // namespace eyepoint::terrain
