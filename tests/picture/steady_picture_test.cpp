/// No jitter: an eye that moves a centimetre a frame moves the picture smoothly, and one that stands still
/// draws the same bits.
///
/// The feature is a pyramid 30 m away against the sky, some 500 pixels above the horizon. Its place in a
/// frame is the mean of the places where its two sides cross several hundred rows: each crossing is known to
/// half a pixel, their mean to a few hundredths, as the sides are slanted and cross the pixels' centres at
/// ever different fractions. Positions held in 32-bit floats at the Earth's radius would move it by up to
/// half a metre, 25 pixels.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "tests/picture/reference_camera.hpp"
#include "tests/picture/renderer.hpp"
#include "tests/picture/spike_terrain.hpp"
#include "tests/support/analytic_terrain.hpp"

namespace eyepoint::testing {
namespace {

constexpr double kStepM = 0.01;
constexpr int kFrames = 60;
/// What the project allows a measured place to stray from the straight motion.
constexpr double kLargestResidualPx = 0.05;
constexpr double kWayM = 30.0;
constexpr double kEyeHeightM = 2.0;
/// 1920x1080 without its sides, where nothing is.
constexpr ig::PictureSize kSize{640, 1080};
/// Between apex and horizon.
constexpr int kFirstRow = 80, kLastRow = 500;

struct Ground {
    std::string name;
    Place place;
};

void PrintTo(const Ground& ground, std::ostream* out) { *out << ground.name; }

/// Mean of the places where the rows enter and leave the pyramid; every row crosses it in one piece.
double middle_of_feature(const ig::Picture& picture, int first_row, int last_row) {
    double sum = 0.0;
    for (int y = first_row; y < last_row; ++y) {
        int left = 0, right = picture.size.width_px - 1;
        while (left < right && is_sentinel(picture, left, y)) ++left;
        while (right > left && is_sentinel(picture, right, y)) --right;
        if (left == right) throw std::runtime_error("row " + std::to_string(y) + " holds no terrain");
        sum += (left + right + 1) / 2.0;
    }
    return sum / (last_row - first_row);
}

/// The same of the outline by the plain projection: straight sides, so their middle row is their mean.
double expected_middle(const Outline& outline, int first_row, int last_row) {
    const double row = (first_row + last_row) / 2.0;
    const auto crossing_x = [&](const glm::dvec2& end) {
        return outline.apex.x + (end.x - outline.apex.x) * (row - outline.apex.y) / (end.y - outline.apex.y);
    };
    return (crossing_x(outline.one_end) + crossing_x(outline.other_end)) / 2.0;
}

class SteadyPicture : public ::testing::TestWithParam<Ground> {
  protected:
    SteadyPicture() : spike_{on_post(GetParam().place, 17), 17, 1, 1} {
        spike_.apex.height_m = 12.0;
        ig::SceneOptions options;
        options.sentinel = true;
        renderer_.emplace(make_spike_database(spike_, scratch_.path() / "terrain"), kSize, options);
    }
    /// 30 m south of the pyramid, looking at it, level, then moved.
    [[nodiscard]] CameraPose pose(const glm::dvec2& east_north_m) const {
        Place eye = moved(spike_.apex, 180.0, kWayM);
        eye.height_m = kEyeHeightM;
        CameraPose result = looking_at(eye, ecef_of(spike_.apex));
        result.pitch_deg = 0.0;
        result.width_px = kSize.width_px;
        const double azimuth_deg = std::atan2(east_north_m.x, east_north_m.y) * 180.0 / std::acos(-1.0);
        result.place = moved(eye, result.yaw_deg + azimuth_deg, glm::length(east_north_m));
        return result;
    }
    /// Flies the eye and compares every frame with the plain projection; returns how far the feature went.
    [[nodiscard]] double follow(const std::function<glm::dvec2(int)>& east_north_m) {
        double largest_px = 0.0, first_px = 0.0, last_px = 0.0;
        for (int frame = 0; frame < kFrames; ++frame) {
            const CameraPose at = pose(east_north_m(frame));
            const double expected_px =
                expected_middle(outline(spike_, ReferenceCamera(at)), kFirstRow, kLastRow);
            last_px = middle_of_feature(renderer_->draw_complete(at).picture, kFirstRow, kLastRow);
            if (frame == 0) first_px = last_px;
            EXPECT_NEAR(last_px, expected_px, kLargestResidualPx) << "frame " << frame;
            largest_px = std::max(largest_px, std::abs(last_px - expected_px));
        }
        std::printf("%.2f px in %d frames, at most %.4f px from the plain projection\n", last_px - first_px,
                    kFrames, largest_px);
        return last_px - first_px;
    }

    ScratchFolder scratch_;
    Spike spike_;
    std::optional<Renderer> renderer_;
};

TEST_P(SteadyPicture, MovesStraightWithAnEyeThatMovesACentimetreAFrameSideways) {
    const double moved_px = follow([](int frame) { return glm::dvec2{frame * kStepM, 0.0}; });
    const double kappa_px = ReferenceCamera(pose({0.0, 0.0})).pixels_per_tangent();
    EXPECT_GT(std::abs(moved_px), 0.9 * kappa_px * (kFrames - 1) * kStepM / kWayM);  // it did move, 29 px
}

TEST_P(SteadyPicture, MovesStraightWithAnEyeThatComesACentimetreAFrameNearer) {
    (void)follow([](int frame) { return glm::dvec2{0.1, frame * kStepM}; });
}

TEST_P(SteadyPicture, IsTheSameBitsWhileTheEyeStandsStill) {
    const ig::View view = view_of(pose({0.123, 0.456}));
    const ig::Picture first = renderer_->draw_complete(view);
    ig::Picture again;
    for (int frame = 0; frame < 5; ++frame) {
        renderer_->draw_now(view, again);
        EXPECT_EQ(first.rgba, again.rgba) << frame;
    }
}

INSTANTIATE_TEST_SUITE_P(Earth, SteadyPicture,
                         ::testing::Values(Ground{"Equator", {0.0, 10.0, 0.0}},
                                           Ground{"North47", {46.95, 7.44, 0.0}},
                                           Ground{"Antimeridian", {-17.0, 179.9999, 0.0}},
                                           Ground{"South80", {-80.0, -123.0, 0.0}}),
                         [](const auto& instance) { return instance.param.name; });

}  // namespace
}  // namespace eyepoint::testing
