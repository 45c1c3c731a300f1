/// Shading after raster draws what shading with the triangles draws.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>

#include <gtest/gtest.h>

#include "tests/picture/flights.hpp"
#include "tests/picture/renderer.hpp"

namespace eyepoint::testing {
namespace {

constexpr ig::PictureSize kSize{480, 270};

struct Scenery {
    std::string name;
    CameraPose pose;
};

void PrintTo(const Scenery& scenery, std::ostream* out) { *out << scenery.name; }

CameraPose pose(Place place, double yaw_deg, double pitch_deg, double roll_deg) {
    return {.place = place,
            .yaw_deg = yaw_deg,
            .pitch_deg = pitch_deg,
            .roll_deg = roll_deg,
            .width_px = kSize.width_px,
            .height_px = kSize.height_px};
}

/// Whether the ground at a pixel and at those around it is one piece: no sky, no jump of the distance by a
/// tenth.
bool is_inside(const DrawnPicture& drawn, int x, int y) {
    if (x < 1 || y < 1 || x + 1 >= kSize.width_px || y + 1 >= kSize.height_px) return false;
    const double here = drawn.distance_at(x, y);
    for (int row = y - 1; row <= y + 1; ++row) {
        for (int column = x - 1; column <= x + 1; ++column) {
            const double there = drawn.distance_at(column, row);
            if (!(there > 0.0) || std::abs(there - here) > 0.1 * here) return false;
        }
    }
    return true;
}

int difference(const ig::Picture& a, const ig::Picture& b, int x, int y) {
    const auto at = (static_cast<std::size_t>(y) * static_cast<std::size_t>(kSize.width_px) +
                     static_cast<std::size_t>(x)) *
                    ig::Picture::kBytesPerPixel;
    int largest = 0;
    for (std::size_t channel = 0; channel < 3; ++channel)
        largest = std::max(largest, std::abs(a.rgba[at + channel] - b.rgba[at + channel]));
    return largest;
}

/// The noise is taken from the nearest of its smaller copies; where a pixel's size on the ground is between
/// two, the last bit decides. Shading after raster knows places to a 32768th of a tile.
constexpr double kUndecidedShare = 0.002;

class ShadingPicture : public ::testing::TestWithParam<Scenery> {
  protected:
    [[nodiscard]] static DrawnPicture draw(ig::Shading shading) {
        ig::SceneOptions options;
        options.shading = shading;
        Renderer renderer(open_synthetic_terrain(), kSize, options);
        DrawnPicture drawn = renderer.draw_complete(GetParam().pose);
        keep_for_looking(drawn.picture,
                         GetParam().name + (shading == ig::Shading::Deferred ? "-deferred" : "-forward"));
        return drawn;
    }
};

TEST_P(ShadingPicture, IsTheSameAfterRasterToTwoStepsButOnSilhouettes) {
    const DrawnPicture forward = draw(ig::Shading::Forward), deferred = draw(ig::Shading::Deferred);
    EXPECT_EQ(forward.distance_m, deferred.distance_m);
    int inside = 0, differing = 0, worst = 0;
    for (int y = 0; y < kSize.height_px; ++y) {
        for (int x = 0; x < kSize.width_px; ++x) {
            if (!is_inside(forward, x, y)) continue;
            const int steps = difference(forward.picture, deferred.picture, x, y);
            ++inside;
            differing += steps > 2 ? 1 : 0;
            worst = std::max(worst, steps);
        }
    }
    EXPECT_GT(inside, kSize.width_px * kSize.height_px / 4);
    EXPECT_LE(differing, inside * kUndecidedShare)
        << "the worst of " << inside << " by " << worst << " steps";
}

/// So that it is the least that drawing the same surface costs: nothing is left out.
TEST_P(ShadingPicture, TheFloorHasTheFramesDepthAndShadesAllOfIt) {
    ig::SceneOptions options;
    options.sentinel = true;
    Renderer renderer(open_synthetic_terrain(), kSize, options);
    const DrawnPicture frame = renderer.draw_complete(GetParam().pose);
    const DrawnPicture floor = renderer.draw_floor(view_of(GetParam().pose));
    EXPECT_EQ(floor.distance_m, frame.distance_m);
    for (int y = 0; y < kSize.height_px; ++y) {
        for (int x = 0; x < kSize.width_px; ++x)
            ASSERT_EQ(is_sentinel(floor.picture, x, y), is_sentinel(frame.picture, x, y)) << x << " " << y;
    }
}

TEST_P(ShadingPicture, AutomaticSettlesOnOneOfTheTwoInTheFirstFrame) {
    ig::SceneOptions options;
    options.shading = ig::Shading::Automatic;
    Renderer renderer(open_synthetic_terrain(), kSize, options);
    const DrawnPicture first = renderer.draw_complete(GetParam().pose);
    ASSERT_NE(renderer.shading(), ig::Shading::Automatic);
    options.shading = renderer.shading();
    Renderer told(open_synthetic_terrain(), kSize, options);
    EXPECT_EQ(told.draw_complete(GetParam().pose).picture.rgba, first.picture.rgba);
}

INSTANTIATE_TEST_SUITE_P(Synthetic, ShadingPicture,
                         ::testing::Values(Scenery{"coast", pose({46.04, 8.03, 1500.0}, 205.0, -14.0, -12.0)},
                                           Scenery{"valley", pose({46.45, 8.2, 2500.0}, 60.0, -8.0, 0.0)},
                                           Scenery{"orbit", pose({45.0, 7.0, 400000.0}, 0.0, -40.0, 0.0)}),
                         [](const auto& instance) { return instance.param.name; });

}  // namespace
}  // namespace eyepoint::testing
