/// The nested method on a recorded flight over the synthetic planet.
#include <algorithm>
#include <bit>
#include <vector>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "terrain/lod/nested.hpp"
#include "tests/picture/flights.hpp"
#include "tests/proof/proven_flight.hpp"
#include "tests/terrain/lod/nested_mesh.hpp"

namespace eyepoint::testing {
namespace {

using Triangles = std::vector<DrawnTriangle>;

/// Drawn triangles, without those wholly outside one side of the view.
Triangles triangles_in_view(const terrain::Selection& selection, const terrain::LodView& view) {
    Triangles triangles = drawn_triangles(selection.draws, terrain::motion_view(view));
    const auto point = [](const PointBits& bits) {
        return glm::dvec3{std::bit_cast<float>(bits[0]), std::bit_cast<float>(bits[1]),
                          std::bit_cast<float>(bits[2])};
    };
    std::erase_if(triangles, [&](const DrawnTriangle& triangle) {
        return std::any_of(view.sides.begin(), view.sides.end(), [&](const glm::dvec3& side) {
            return std::all_of(triangle.corners.begin(), triangle.corners.end(),
                               [&](const PointBits& corner) { return glm::dot(side, point(corner)) < 0.0; });
        });
    });
    return triangles;
}

TEST(RecordedFlightProof, BlocksCutIntoCellsDrawTheTrianglesOfWholeBlocks) {
    const auto database = open_synthetic_terrain();
    const auto views = views_of(eyes_of(sample_flight(), {640, 480}, 30.0), {1.0, 0.1});
    terrain::NestedLod whole(true, false, false), cut;
    auto pager = terrain::Pager::create(
                     database, {.mesh = terrain::MeshKind::Nested, .cache_bytes = std::size_t{8} << 30})
                     .value();
    std::uint64_t number = 0;
    const std::size_t step = every_frame() ? 1 : 40;
    for (std::size_t frame = 0; frame < views.size(); frame += step) {
        const terrain::LodView& view = views[frame];
        do {
            pager->publish(100000, number);
            pager->request(whole.select(view, pager->tree(), ++number).wishes);
        } while (pager->wait_for_loads());
        const Triangles expected = triangles_in_view(whole.select(view, pager->tree(), ++number), view);
        const Triangles drawn = triangles_in_view(cut.select(view, pager->tree(), number), view);
        EXPECT_TRUE(drawn == expected)
            << "frame " << frame << ": " << drawn.size() << " triangles, not " << expected.size();
    }
}

TEST(RecordedFlightProof, IsWholeAndWithinTheTolerance) {
    ProvenFlight flight(open_synthetic_terrain());
    const auto eyes = eyes_of(sample_flight(), {800, 800}, 30.0);
    const std::size_t every = eyes.size() / 2;
    for (std::size_t i = 0; i < kTolerances.size(); ++i) {
        const Tolerance& tolerance = kTolerances[i];
        const auto views = views_of(eyes, tolerance);
        const std::size_t start = every_frame() ? 0 : i * every / kTolerances.size();
        expect_sound(flight.fly(std::span{views}.subspan(start), {.every = one_in(every), .pops = false}),
                     fmt::format("tau {}, slack {} tau", tolerance.tau_px, tolerance.slack_share));
    }
}

TEST(RecordedFlightProof, IsWholeWhileAFewBlocksArriveAFrame) {
    const auto views = views_of(eyes_of(sample_flight(), {800, 800}, 30.0), {1.0, 0.1});
    const std::size_t frames = every_frame() ? 900 : 60;
    EXPECT_GT(expect_whole_while_loading(open_synthetic_terrain(), std::span{views}.subspan(0, frames), 5,
                                         one_in(20)),
              frames / 2);
}

}  // namespace
}  // namespace eyepoint::testing
