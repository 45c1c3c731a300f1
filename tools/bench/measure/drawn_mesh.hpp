/// The triangles of a frame as they are drawn: the vertices where the vertex shader puts them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "terrain/lod/lod_method.hpp"

namespace eyepoint::tools {

/// A place on the Earth in half turns: x east from 180 W (0..2), y north from 90 S (0..1). A tile of depth d
/// is 2^-d across.
using HalfTurns = glm::dvec2;

struct MeshVertex {
    glm::vec3 from_eye{0.0F};  ///< drawn, ECEF axes, metres: the bits that the shader has
    HalfTurns place{0.0};      ///< where it is drawn
    /// Where it is in its tile while it does not move, terrain::kVertexPlaceUnits a side, and which of the
    /// tile's edges it is on: bit n for terrain::kEdges[n].
    glm::u16vec2 own_place{};
    std::uint8_t tile_edges = 0;
};

/// Vertices by their number in DrawnMesh::vertices; counterclockwise from above.
struct MeshTriangle {
    std::array<std::uint32_t, 3> vertices{};
};

/// The triangles that one tile's draws consist of.
struct MeshPart {
    terrain::TileId tile;
    std::size_t first_triangle = 0;
    std::size_t end_triangle = 0;
};

struct DrawnMesh {
    terrain::Ecef eye{0.0};
    std::array<glm::dvec3, 4> sides{};    ///< of the view, LodView::sides
    double lowest_height_m = 0.0;         ///< ellipsoidal, of what is drawn
    std::vector<MeshVertex> vertices;     ///< of every part its own
    std::vector<MeshTriangle> triangles;  ///< all that are drawn, also those that have slid shut
    std::vector<MeshPart> parts;
    std::size_t empty_triangles = 0;  ///< slid shut: two corners are the same bits
};

[[nodiscard]] inline bool same_bits(const glm::vec3& a, const glm::vec3& b) {
    return a.x == b.x && a.y == b.y && a.z == b.z;
}
[[nodiscard]] bool is_empty(const DrawnMesh& mesh, const MeshTriangle& triangle);

/// What the draws of a selection come to for its view. `morph`: as in terrain::motion_view(); nothing to a
/// grid.
[[nodiscard]] DrawnMesh drawn_mesh(const terrain::Selection& selection, const terrain::LodMethod& method,
                                   const terrain::LodView& view, bool morph = true);

}  // namespace eyepoint::tools
