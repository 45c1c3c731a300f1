/// No jitter: an eye that moves a centimetre a frame moves the picture smoothly, and one that stands still
/// draws the same bits.
///
/// The feature is a pyramid 30 m away against the sky, some 600 pixels high. Its place in a frame is the mean of
/// the places where its two sides cross several hundred rows: each crossing is known to half a pixel, their mean
/// to a few hundredths, as the sides are slanted and cross the pixels' centres at ever different fractions.
/// Positions held in 32-bit floats at the Earth's radius would move it by up to half a metre, 25 pixels.
#include <array>
#include <cmath>
#include <string>
#include <vector>

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
        EXPECT_LT(left, right) << "row " << y << " holds no terrain";
        sum += (left + right + 1) / 2.0;
    }
    return sum / (last_row - first_row);
}

struct Line {
    double at_zero = 0.0, slope = 0.0, largest_residual = 0.0;
};

Line straight_line(const std::vector<double>& values) {
    const double n = static_cast<double>(values.size()), middle = (n - 1.0) / 2.0;
    double mean = 0.0, product = 0.0, square = 0.0;
    for (const double value : values) mean += value / n;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double t = static_cast<double>(i) - middle;
        product += t * (values[i] - mean), square += t * t;
    }
    Line line{mean - product / square * middle, product / square, 0.0};
    for (std::size_t i = 0; i < values.size(); ++i)
        line.largest_residual = std::max(
            line.largest_residual, std::abs(values[i] - line.at_zero - line.slope * static_cast<double>(i)));
    return line;
}

class SteadyPicture : public ::testing::TestWithParam<Ground> {
  protected:
    SteadyPicture() : spike_{on_post(GetParam().place, 17), 17, 1} {
        spike_.apex.height_m = 12.0;
        ig::SceneOptions options;
        options.sentinel = true;
        renderer_.emplace(make_spike_database(spike_, scratch_.path() / "terrain"), ig::PictureSize{1920, 1080},
                          options);
    }
    /// 30 m south of the pyramid, looking at its middle, level, then moved.
    [[nodiscard]] CameraPose pose(double east_m, double north_m, double up_m) const {
        Place eye = moved(spike_.apex, 180.0, kWayM);
        eye.height_m = kEyeHeightM;
        CameraPose result = looking_at(eye, ecef_of(spike_.apex));
        result.pitch_deg = 0.0;
        result.vertical_fov_deg = 60.0;
        const double turn = east_m == 0.0 && north_m == 0.0 ? 0.0 : std::atan2(east_m, north_m) * 180.0 / std::acos(-1.0);
        result.place = moved(eye, result.yaw_deg + turn, std::hypot(east_m, north_m));
        result.place.height_m = kEyeHeightM + up_m;
        return result;
    }

    ScratchFolder scratch_;
    Spike spike_;
    std::optional<Renderer> renderer_;
};

constexpr int kFirstRow = 180, kLastRow = 480;

TEST_P(SteadyPicture, MovesStraightWithAnEyeThatMovesACentimetreAFrameSideways) {
    std::vector<double> middles;
    for (int frame = 0; frame < kFrames; ++frame) {
        const CameraPose at = pose(frame * kStepM, 0.0, 0.0);
        middles.push_back(middle_of_feature(renderer_->draw_complete(at).picture, kFirstRow, kLastRow));
    }
    const Line line = straight_line(middles);
    const double expected_px = ReferenceCamera(pose(0.0, 0.0, 0.0)).pixels_per_tangent() * kStepM / kWayM;
    std::printf("%.4f px a frame (expected about %.4f), largest residual %.4f px\n", -line.slope, expected_px,
                line.largest_residual);
    EXPECT_LE(line.largest_residual, kLargestResidualPx);
    EXPECT_NEAR(-line.slope, expected_px, 0.02 * expected_px);  // the sides' distances differ from the apex's
}

TEST_P(SteadyPicture, StaysInPlaceWithAnEyeThatComesACentimetreAFrameNearer) {
    std::vector<double> middles;
    for (int frame = 0; frame < kFrames; ++frame) {
        const CameraPose at = pose(0.0, frame * kStepM, 0.0);
        middles.push_back(middle_of_feature(renderer_->draw_complete(at).picture, kFirstRow, kLastRow));
    }
    EXPECT_LE(straight_line(middles).largest_residual, kLargestResidualPx);
}

TEST_P(SteadyPicture, IsTheSameBitsWhileTheEyeStandsStill) {
    const ig::View view = view_of(pose(0.123, 0.456, 0.0));
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
