/// Where a vertex of a nested mesh is drawn, as a function of the vertex, the eye and the tolerance alone: the vertex
/// shader's computation (ig/render/shaders/nested.glsl), on the CPU, for tests, measures and bounds.
#pragma once

#include <cstdint>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "terrain/block/block.hpp"
#include "terrain/lod/lod_method.hpp"
#include "terrain/pager/tile_tree.hpp"

namespace eyepoint::terrain {

/// A level between meshes, lambda, is asked for at every vertex by its own distance (error_level.hpp, level_at; never
/// less than the floor of the edge it is on). A vertex that goes at level d is drawn
///   P(v) = (1 - t) v + t P(target(v)),  t = clamp(lambda(v) - (d - 1), 0, 1),
/// where a vertex that stays has the target and the level it has in the parent's block. So the drawn surface depends
/// on the eye, not on which blocks and levels draw it: any level k of a block is right where lambda >= k at all its
/// vertices, neighbours of any two levels or depths meet, and a change of level or depth changes no picture.
struct MotionView {
    SplitPosition eye;
    float level_scale = 0.0F;  ///< level_scale(tau + slack, kappa)
    bool morph = true;         ///< false: lambda is rounded down, vertices jump
};
[[nodiscard]] MotionView motion_view(const LodView& view, bool morph = true);

struct DrawnVertex {
    glm::vec3 from_eye{0.0F};  ///< ECEF axes, metres
    glm::vec3 normal{0.0F};    ///< not of unit length
    glm::vec2 place{0.0F};     ///< in the drawn tile, 0..1; outside it where it slid to a vertex beyond
};

/// Ancestors' blocks must be loaded, as they are for every node of a selection. Equal arguments give equal bits, and so
/// do the same vertex from two blocks. Walks at most the tree's depth of ancestors.
[[nodiscard]] DrawnVertex drawn_vertex(const TileNode& node, std::uint16_t vertex, const EdgeFloors& floors,
                                       const MotionView& view);

}  // namespace eyepoint::terrain
