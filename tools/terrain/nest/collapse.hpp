/// One tile's nested mesh: its finest triangulation made coarser level by level by half-edge collapses.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "tools/terrain/nest/sampled_surface.hpp"

namespace eyepoint::tools {

/// A vertex in a tile: place in kPlaceUnits a side from its south-west corner, ellipsoidal height.
struct MeshVertex {
    std::int64_t x = 0;
    std::int64_t y = 0;
    float height_m = 0.0F;
};

struct TriangleMesh {
    std::vector<MeshVertex> vertices;
    std::vector<std::array<std::uint16_t, 3>> triangles;  ///< counterclockwise
};

/// What becomes of a vertex on an edge of the tile, given by the edge alone (edge_lines.hpp): from each level
/// on it is at another place on the line. Levels rise; places may lie beyond the tile from its last level on.
struct EdgeFate {
    struct Step {
        std::uint8_t level = 0;
        MeshVertex place;
    };
    bool on_edge = false;
    std::vector<Step> steps;
};

struct CollapseRequest {
    terrain::TileId tile;
    int first_level = 0;
    int last_level = 0;
    TriangleMesh mesh;  ///< of the first level, edge vertices that go at that level or before included
    std::vector<EdgeFate> fates;  ///< by vertex
    /// By vertex: one on an edge that must go first; itself where there is none.
    std::vector<std::uint16_t> waits_for;
};

/// By vertex, as in terrain::NestedMesh; the coarsest triangles in the numbers of the request's vertices.
struct CollapseResult {
    std::vector<std::uint8_t> gone_level;
    std::vector<std::uint16_t> target;
    std::vector<std::array<std::uint16_t, 3>> coarsest;
};

/// At every level L the mesh is nowhere farther from the samples than kMeshShare * E_L, new triangles have no
/// side longer than level_reach_m(L), and slides, the edges' own too, are as slide.hpp has it, with the error
/// of the level between. No collapse folds a triangle, neither now nor when the edges' own collapses follow
/// at this or any later level: so those never need to be refused. Two exceptions go beyond errors and sides:
/// where a triangle of the request's mesh is in the way of an edge's vertex, and where more vertices would be
/// left than the parent can take.
[[nodiscard]] CollapseResult collapse(const CollapseRequest& request, const SampledSurface& surface);

}  // namespace eyepoint::tools
