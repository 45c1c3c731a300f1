/// Detail that is loaded stays drawn while the view turns towards what is not: one coarse tile coming into
/// view must not hold back the fine ones beside it.
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "terrain/lod/tile/tile_lod.hpp"
#include "terrain/pager/pager.hpp"
#include "tests/picture/flights.hpp"

namespace eyepoint::testing {
namespace {

constexpr double kTauPx = 3.0;

terrain::LodView lod_view(const ig::View& view) {
    const auto inward = [&](const glm::dvec3& normal) { return view.axes * glm::normalize(normal); };
    return {.eye = view.eye_ecef,
            .sides = {inward({1.0, 0.0, view.left}), inward({-1.0, 0.0, -view.right}),
                      inward({0.0, 1.0, view.bottom}), inward({0.0, -1.0, -view.top})},
            .kappa_px = view.pixels_per_radian(),
            .tau_px = kTauPx,
            .near_m = view.near_m};
}

/// The sample flight's turns of 25 to 30 degrees of bank, drawn at the rate of a slow machine; every block
/// arrives one frame after it is wished for.
TEST(SteadyDetail, NoFrameOfTheSampleFlightDropsBelowHalfOfTheOneBefore) {
    constexpr double kFramesPerSecond = 4.0;
    constexpr ig::PictureSize kSize{1280, 720};
    auto pager = terrain::Pager::create(open_synthetic_terrain(), {}).value();
    terrain::TileLod lod;
    std::uint64_t frame = 0, before = 0;
    for (const ig::FlightEye& eye : eyes_of(sample_flight(), kSize, kFramesPerSecond)) {
        const terrain::LodView view = lod_view(eye.eyepoint.view);
        std::uint64_t triangles = 0;
        do {
            pager->publish(100'000, frame);
            const terrain::Selection& selection = lod.select(view, pager->tree(), ++frame);
            triangles = selection.triangles;
            pager->request(selection.wishes);
        } while (pager->wait_for_loads() && before == 0);
        EXPECT_GT(triangles, before / 2) << "at " << eye.time_s << " s";
        before = triangles;
    }
    EXPECT_GT(before, 100'000U);
}

}  // namespace
}  // namespace eyepoint::testing
