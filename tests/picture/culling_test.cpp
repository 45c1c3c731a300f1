/// Horizon culling changes no pixel: pictures with and without it, bit by bit, over the synthetic planet's
/// mountains, from the sample flight and from eyes of its own, banked and low.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tests/picture/flights.hpp"
#include "tests/picture/renderer.hpp"

namespace eyepoint::testing {
namespace {

constexpr ig::PictureSize kSize{480, 360};
constexpr double kRateHz = 30.0;

struct Look {
    ig::View view;
    std::string from;
};

std::vector<Look> looks() {
    std::vector<Look> result;
    const auto eyes = eyes_of(sample_flight(), kSize, kRateHz);
    for (std::size_t i = 0; i < eyes.size(); i += 150)
        result.push_back({eyes[i].eyepoint.view, "sample flight, eye " + std::to_string(i)});
    for (const double height_m : {700.0, 1000.0, 1500.0, 2500.0}) {
        for (int turn = 0; turn < 8; ++turn) {
            const CameraPose pose{.place = {46.04 + 0.02 * turn, 8.03 + 0.03 * turn, height_m},
                                  .yaw_deg = 47.0 * turn,
                                  .pitch_deg = -12.0 + 3.0 * (turn % 5),
                                  .roll_deg = 35.0 * (turn % 4) - 60.0,
                                  .width_px = kSize.width_px,
                                  .height_px = kSize.height_px};
            result.push_back({view_of(pose), std::to_string(height_m) + " m, turn " + std::to_string(turn)});
        }
    }
    return result;
}

struct Drawn {
    std::vector<ig::Picture> pictures;
    std::uint64_t triangles = 0;
};

/// One scene at a time: the context drawn with is the thread's last made.
Drawn draw(const std::vector<Look>& views, double tau_px, bool culled) {
    ig::SceneOptions options;
    options.lod_method = "nested";
    options.tau_px = tau_px;
    options.shading = ig::Shading::Forward;
    options.horizon_culling = culled;
    Renderer renderer(open_synthetic_terrain(), kSize, options);
    Drawn drawn;
    for (const Look& look : views) {
        ig::Picture picture = renderer.draw_complete(look.view);
        drawn.triangles += renderer.draw_now(look.view, picture).triangles;
        drawn.pictures.push_back(std::move(picture));
    }
    return drawn;
}

std::size_t differing_pixels(const ig::Picture& a, const ig::Picture& b) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.rgba.size(); i += ig::Picture::kBytesPerPixel)
        count +=
            std::equal(a.rgba.data() + i, a.rgba.data() + i + ig::Picture::kBytesPerPixel, b.rgba.data() + i)
                ? 0
                : 1;
    return count;
}

class HorizonCullingPicture : public ::testing::TestWithParam<double> {};

TEST_P(HorizonCullingPicture, IsTheSameToTheBit) {
    const std::vector<Look> views = looks();
    const Drawn all = draw(views, GetParam(), false), culled = draw(views, GetParam(), true);
    for (std::size_t i = 0; i < views.size(); ++i)
        EXPECT_EQ(differing_pixels(all.pictures[i], culled.pictures[i]), 0U) << views[i].from;
    RecordProperty("left_out_percent", static_cast<int>(100 - 100 * culled.triangles / all.triangles));
    EXPECT_LT(culled.triangles, all.triangles - all.triangles / 20);
}

INSTANTIATE_TEST_SUITE_P(Tolerances, HorizonCullingPicture, ::testing::Values(0.5, 1.0, 2.0));

}  // namespace
}  // namespace eyepoint::testing
