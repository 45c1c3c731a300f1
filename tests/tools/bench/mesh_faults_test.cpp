#include "tools/bench/measure/mesh_faults.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "tests/tools/bench/small_flight.hpp"

namespace eyepoint::tools {
namespace {

using testing::look_north;
using testing::SmallFlight;
using testing::vertex_in_sight;

class MeshWithFaults : public ::testing::Test {
  protected:
    SmallFlight flight{testing::small_hills()};
    terrain::LodView view = look_north(46.4, 8.25, 6000.0, 30.0, 2.0);
    DrawnMesh mesh = flight.mesh(view);

    [[nodiscard]] bool in_view(std::uint32_t vertex) const {
        return std::all_of(view.sides.begin(), view.sides.end(), [&](const glm::dvec3& side) {
            return glm::dot(side, glm::dvec3{mesh.vertices[vertex].from_eye}) > 0.0;
        });
    }
    /// A triangle in view with no corner on its tile's edge.
    [[nodiscard]] MeshTriangle& inner_triangle() {
        for (MeshTriangle& triangle : mesh.triangles) {
            bool inner = true;
            for (const std::uint32_t corner : triangle.vertices) {
                inner = inner && mesh.vertices[corner].tile_edges == 0 && in_view(corner);
            }
            if (inner) return triangle;
        }
        return mesh.triangles.front();
    }
};

TEST_F(MeshWithFaults, HasNoneAsItIsDrawn) {
    const MeshFaults faults = find_mesh_faults(mesh);
    EXPECT_GT(faults.edges, 1000U);
    EXPECT_GT(faults.borders, 0U);
    EXPECT_EQ(faults.cracks, 0U);
    EXPECT_EQ(faults.overlaps, 0U);
}

TEST_F(MeshWithFaults, AMissingTriangleLeavesThreeEdges) {
    MeshTriangle& triangle = inner_triangle();
    triangle.vertices = {triangle.vertices[0], triangle.vertices[0], triangle.vertices[0]};
    EXPECT_EQ(find_mesh_faults(mesh).cracks, 3U);
}

TEST_F(MeshWithFaults, WhatIsMissingBesideTheViewIsNoCrack) {
    MeshTriangle& triangle = inner_triangle();
    for (glm::dvec3& side : mesh.sides) side = -side;
    const std::size_t borders = find_mesh_faults(mesh).borders;
    triangle.vertices = {triangle.vertices[0], triangle.vertices[0], triangle.vertices[0]};
    const MeshFaults faults = find_mesh_faults(mesh);
    EXPECT_EQ(faults.borders, borders + 3);
    EXPECT_EQ(faults.cracks, 0U);
}

TEST_F(MeshWithFaults, ATriangleDrawnTwiceOverlaps) {
    const MeshTriangle triangle = inner_triangle();
    mesh.triangles.push_back(triangle);
    mesh.parts.back().end_triangle = mesh.triangles.size();
    EXPECT_EQ(find_mesh_faults(mesh).overlaps, 3U);
}

TEST_F(MeshWithFaults, ATriangleThatHasSlidShutIsNone) {
    // Both triangles on an edge collapse with it: every vertex in one end's place is put in the other's.
    const MeshTriangle triangle = inner_triangle();
    const glm::vec3 gone = mesh.vertices[triangle.vertices[0]].from_eye,
                    target = mesh.vertices[triangle.vertices[1]].from_eye;
    for (MeshVertex& vertex : mesh.vertices) {
        if (same_bits(vertex.from_eye, gone)) vertex.from_eye = target;
    }
    const MeshFaults faults = find_mesh_faults(mesh);
    EXPECT_EQ(faults.cracks, 0U);
    EXPECT_EQ(faults.overlaps, 0U);
}

/// One bit of one vertex on the edge between two tiles, in one of them.
TEST_F(MeshWithFaults, OneBitOnASharedEdgeIsACrack) {
    const MeshFaults whole = find_mesh_faults(mesh);
    std::size_t cracked = 0;
    for (std::size_t i = 0; i < mesh.vertices.size() && cracked == 0; ++i) {
        if (mesh.vertices[i].own_place.x != 0) continue;
        float& x = mesh.vertices[i].from_eye.x;
        const float was = x;
        x = std::nextafter(x, 1e9F);
        cracked = find_mesh_faults(mesh).cracks;
        x = was;
    }
    EXPECT_EQ(whole.cracks, 0U);
    EXPECT_GE(cracked, 2U);
}

/// A tile left out in the middle: what its neighbours end at is a border only because nothing is drawn there;
/// drawn tiles that end at it without meeting it crack.
TEST_F(MeshWithFaults, TheEdgeOfWhatIsDrawnIsABorder) {
    const MeshFaults before = find_mesh_faults(mesh);
    const MeshPart nearest = mesh.parts.front();
    mesh.parts.erase(mesh.parts.begin());
    const MeshFaults without = find_mesh_faults(mesh);
    EXPECT_EQ(without.cracks, 0U);
    EXPECT_GT(without.borders, before.borders);

    MeshPart emptied = nearest;
    emptied.end_triangle = emptied.first_triangle;
    mesh.parts.push_back(emptied);
    EXPECT_GT(find_mesh_faults(mesh).cracks, 0U);
}

}  // namespace
}  // namespace eyepoint::tools
