/// Cracks, by topology: where the triangles drawn in a frame do not share their edges bit for bit.
#pragma once

#include <cstddef>

#include "tools/bench/measure/drawn_mesh.hpp"

namespace eyepoint::tools {

/// A whole mesh has every edge in two triangles with bit-equal end points, once in each direction, but for
/// those on the edge of a tile beside which nothing is drawn, at the poles, beside the view and behind the
/// curve of the Earth. Triangles that have slid shut count as what they are: three edges, one of no length
/// and two that cancel each other.
struct MeshFaults {
    std::size_t edges = 0;     ///< different ones looked at
    std::size_t borders = 0;   ///< of them: in one triangle, at the end of what is drawn
    std::size_t cracks = 0;    ///< in one triangle, and not there
    std::size_t overlaps = 0;  ///< in more than two triangles
    [[nodiscard]] bool whole() const { return cracks == 0 && overlaps == 0; }
};
[[nodiscard]] MeshFaults find_mesh_faults(const DrawnMesh& mesh);

}  // namespace eyepoint::tools
