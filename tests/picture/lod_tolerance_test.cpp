/// What is drawn stays within the tolerance of the true surface, also in the strip of cells along an edge
/// whose posts are thinned to meet a coarser neighbour.
///
/// A pyramid's apex stands one row of posts from its tile's northern edge. Its side towards the edge is
/// known, and the drawn outline may be the tolerance away from it, and half a pixel for the pixels
/// themselves.
#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "tests/picture/reference_camera.hpp"
#include "tests/picture/renderer.hpp"
#include "tests/picture/silhouette.hpp"
#include "tests/picture/spike_terrain.hpp"
#include "tests/support/analytic_terrain.hpp"

namespace eyepoint::testing {
namespace {

TEST(LodTolerance, HoldsBesideAnEdgeThatMeetsACoarserNeighbour) {
    constexpr unsigned kDepth = 17;
    Place apex = on_post({-17.0, -179.95, 12.0}, kDepth);
    const double spacing_deg = 180.0 / 32.0 / std::ldexp(1.0, kDepth);
    const double row = std::round((apex.latitude_deg + 90.0) / spacing_deg);
    apex.latitude_deg = (std::floor(row / 32.0) * 32.0 + 31.0) * spacing_deg - 90.0;
    const Spike spike{apex, kDepth, 1, 1};
    const ScratchFolder scratch;
    ig::SceneOptions options;
    options.sentinel = true;
    Renderer renderer(make_spike_database(spike, scratch.path() / "terrain"), {1920, 1080}, options);

    Place eye = moved(apex, 40.0, 60.0);
    eye.height_m = 2.0;
    CameraPose pose = looking_at(eye, ecef_of({apex.latitude_deg, apex.longitude_deg, 6.0}));
    const auto [top, one_end, other_end] = outline(spike, ReferenceCamera(pose));
    const DrawnPicture drawn = renderer.draw_complete(pose);
    const Coverage covers = [&](int x, int y) { return !is_sentinel(drawn.picture, x, y); };
    for (const glm::dvec2& end : {one_end, other_end}) {
        const auto edge = fit_edge(covers, top, end, (top + one_end + other_end) / 3.0);
        ASSERT_TRUE(edge.has_value()) << "the drawn side is more than " << kEdgeSearchPx
                                      << " px from the one that ends at " << end.x << " " << end.y;
        const glm::dvec2 middle = (top + end) / 2.0;
        const double off_px = edge->steep ? edge->at(middle.y) - middle.x : edge->at(middle.x) - middle.y;
        EXPECT_LE(std::abs(off_px), options.tau_px + 0.5);
    }
}

}  // namespace
}  // namespace eyepoint::testing
