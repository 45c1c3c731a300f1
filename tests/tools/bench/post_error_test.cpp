#include "tools/bench/measure/post_error.hpp"

#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "terrain/geodesy/earth.hpp"
#include "tests/tools/bench/small_flight.hpp"

namespace eyepoint::tools {
namespace {

using testing::look_north;
using testing::SmallFlight;
using testing::vertex_in_sight;

/// Raises a vertex, with all that are in the same place, along the vertical.
DrawnMesh raised(DrawnMesh mesh, std::size_t vertex, double by_m) {
    const glm::vec3 from_eye = mesh.vertices[vertex].from_eye;
    const auto place = terrain::to_geodetic(mesh.eye + glm::dvec3{from_eye});
    const glm::dvec3 up = terrain::east_north_up(place.latitude_deg, place.longitude_deg)[2];
    for (MeshVertex& each : mesh.vertices) {
        if (same_bits(each.from_eye, from_eye)) each.from_eye = glm::vec3{glm::dvec3{from_eye} + up * by_m};
    }
    return mesh;
}

/// The benchmark's formula, |dz| * h / D^2 * kappa, worked out from latitude and longitude.
double expected_px(const DrawnMesh& mesh, std::size_t vertex, const terrain::LodView& view, double raised_m) {
    const glm::dvec3 from_eye{mesh.vertices[vertex].from_eye};
    const auto place = terrain::to_geodetic(mesh.eye + from_eye);
    const glm::dvec3 up = terrain::east_north_up(place.latitude_deg, place.longitude_deg)[2];
    const double distance = glm::length(from_eye), horizontal = glm::length(glm::cross(from_eye, up));
    return raised_m * horizontal / (distance * distance) * view.kappa_px;
}

class RaisedVertex : public ::testing::Test {
  protected:
    SmallFlight flight{testing::small_hills()};
    terrain::LodView view = look_north(46.4, 8.25, 6000.0, 30.0, 0.05);
    DrawnMesh mesh = flight.mesh(view);
    std::size_t vertex = vertex_in_sight(mesh, view);
};

TEST_F(RaisedVertex, IsOffByWhatItWasRaisedProjected) {
    for (const double by_m : {25.0, -3.0}) {
        const PostFigures figures = flight.figures(raised(mesh, vertex, by_m), view);
        const double expected = expected_px(mesh, vertex, view, std::abs(by_m));
        EXPECT_NEAR(figures.error.maximum(), expected, expected * 1e-3);
        EXPECT_EQ(figures.uncovered, 0U);
    }
}

TEST_F(RaisedVertex, IsAPopBetweenTwoFrames) {
    const MeasuredPosts before = flight.measure(mesh, view);
    const MeasuredPosts after = flight.measure(raised(mesh, vertex, 25.0), view);
    const double expected = expected_px(mesh, vertex, view, 25.0);
    EXPECT_NEAR(pops(before, after).maximum(), expected, expected * 1e-3);
    EXPECT_NEAR(pops(after, before).maximum(), expected, expected * 1e-3);
    EXPECT_EQ(pops(before, before).maximum(), 0.0);
    EXPECT_EQ(pops(before, after).count(), post_figures(before).error.count());
}

TEST_F(RaisedVertex, LeavesAHoleWhenItsTrianglesAreGone) {
    DrawnMesh torn = mesh;
    const glm::vec3 from_eye = mesh.vertices[vertex].from_eye;
    for (MeshTriangle& triangle : torn.triangles) {
        for (const std::uint32_t corner : triangle.vertices) {
            if (same_bits(mesh.vertices[corner].from_eye, from_eye)) {
                triangle.vertices[1] = triangle.vertices[2] = triangle.vertices[0];
                break;
            }
        }
    }
    EXPECT_GE(flight.figures(torn, view).uncovered, 1U);
}

TEST_F(RaisedVertex, MovedSidewaysOverItsNeighboursMakesAFold) {
    DrawnMesh folded = mesh;
    const glm::vec3 from_eye = mesh.vertices[vertex].from_eye;
    const auto place = terrain::to_geodetic(mesh.eye + glm::dvec3{from_eye});
    const glm::dvec3 east = terrain::east_north_up(place.latitude_deg, place.longitude_deg)[0];
    for (MeshVertex& each : folded.vertices) {
        if (same_bits(each.from_eye, from_eye))
            each.from_eye = glm::vec3{glm::dvec3{from_eye} + east * 1000.0};
        if (each.own_place == mesh.vertices[vertex].own_place) each.place.x += 1000.0 / 20e6;
    }
    const PostFigures figures = flight.figures(folded, view);
    EXPECT_GE(figures.folded, 1U);
    EXPECT_EQ(figures.uncovered, 0U);
    EXPECT_EQ(figures.overlapped, 0U);  // a layer from above and one from below cancel each other
}

}  // namespace
}  // namespace eyepoint::tools
