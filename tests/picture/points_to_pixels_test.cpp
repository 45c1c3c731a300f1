/// Known terrain points as drawn against the plain double-precision projection: within half a pixel at
/// 1920x1080, from 2 m to 400 km, wherever on the Earth.
///
/// The known point is the apex of a pyramid (of hundreds of pixels) on a bare ellipsoid. Both sides of its
/// outline are fitted with straight lines, and where they cross is where the apex was drawn: the fit knows it
/// to about a tenth of a pixel, where a single pixel's coverage would say half a pixel.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "tests/picture/reference_camera.hpp"
#include "tests/picture/renderer.hpp"
#include "tests/picture/silhouette.hpp"
#include "tests/picture/spike_terrain.hpp"
#include "tests/support/analytic_terrain.hpp"

namespace eyepoint::testing {
namespace {

/// The issue's own bound.
constexpr double kLargestErrorPx = 0.5;
/// Tolerance of the drawing: where a point belongs is judged, not what level of detail leaves out.
constexpr double kTauPx = 0.2;

/// How high the eye is, and a pyramid and a way to it that suit that height.
struct Height {
    std::string name;
    double eye_m = 0.0;
    unsigned depth = 0;
    double apex_m = 0.0;
    double way_m = 0.0;
    double fov_deg = 40.0;
};
const std::array<Height, 3> kHeights{{{"At2m", 2.0, 16, 12.0, 60.0},
                                      {"At10km", 10e3, 8, 5e3, 22e3},
                                      {"At400km", 400e3, 6, 24e3, 300e3, 15.0}}};

/// Where the pyramid stands, and the azimuths from there towards the eye.
struct Ground {
    std::string name;
    Place place;
    std::vector<double> eye_azimuths_deg{40.0, 130.0, 220.0, 310.0};
};

struct Case {
    std::string name;
    Spike spike;
    double eye_height_m = 0.0;
    double way_m = 0.0;
    double fov_deg = 0.0;
    std::vector<double> eye_azimuths_deg;
};

Case case_on(const Ground& ground, const Height& height) {
    Place apex = on_post(ground.place, height.depth);
    apex.height_m = height.apex_m;
    return {ground.name + height.name, {apex, height.depth, 1, 1}, height.eye_m, height.way_m, height.fov_deg,
            ground.eye_azimuths_deg};
}

/// An eye within a kilometre of the pole and a pyramid further down the meridian, or across the pole, which
/// is wider in columns than in rows of posts: columns are centimetres apart there.
struct PolarSight {
    unsigned depth = 0;
    int half_height_rows = 1;
    double apex_from_pole_m = 0.0;
    double way_m = 0.0;  ///< from the apex towards the pole, and past it where it is longer
    std::vector<double> eye_azimuths_deg;
};

Case case_near_pole(const Height& height, const PolarSight& sight) {
    constexpr double kMetresPerDegree = 111'694.0;  // of the meridian at the pole
    const double spacing_deg = 180.0 / std::ldexp(32.0, static_cast<int>(sight.depth));
    const double rows = std::round(sight.apex_from_pole_m / kMetresPerDegree / spacing_deg);
    Place apex = on_post({90.0, 33.0, 0.0}, sight.depth);
    apex.latitude_deg = 90.0 - rows * spacing_deg;
    apex.height_m = height.apex_m;
    const double column_m =
        spacing_deg * kMetresPerDegree * std::cos(apex.latitude_deg * std::acos(-1.0) / 180.0);
    const int columns = static_cast<int>(std::lround(0.2 * height.apex_m / column_m));
    return {"EyeWithin1kmOfPole" + height.name,
            {apex, sight.depth, sight.half_height_rows, columns},
            height.eye_m,
            sight.way_m,
            height.fov_deg,
            sight.eye_azimuths_deg};
}

/// The antimeridian runs between the two grounds beside it and through the third.
std::vector<Case> all_cases() {
    std::vector<Case> cases;
    for (const Height& height : kHeights) {
        cases.push_back(case_on({"Equator", {0.0, 10.0, 0.0}}, height));
        cases.push_back(case_on({"North60", {60.0, 25.0, 0.0}}, height));
        cases.push_back(case_on({"EastOf180", {-17.0, -179.95, 0.0}}, height));
        cases.push_back(case_on({"WestOf180", {-17.0, 179.95, 0.0}}, height));
        cases.push_back(case_on({"On180", {52.0, -180.0, 0.0}, {80.0, 280.0}}, height));
    }
    for (std::size_t i = 1; i < kHeights.size(); ++i)
        cases.push_back(case_on({"PoleItself", {-90.0, 0.0, 0.0}}, kHeights[i]));
    cases.push_back(case_near_pole(kHeights[0], {15, 1, 480.0, 60.0, {0.0}}));
    cases.push_back(case_near_pole(kHeights[1], {8, 1, 20e3, 20.2e3, {0.0, 1.0}}));
    cases.push_back(case_near_pole(kHeights[2], {10, 8, 300e3, 300.2e3, {0.0, 0.1}}));
    return cases;
}

/// Turns of the eye away from the point, degrees: yaw, pitch (both for a field of view of 40), roll.
constexpr double kTurnsFovDeg = 40.0;
constexpr std::array<std::array<double, 3>, 4> kTurns{
    {{0.0, 0.0, 0.0}, {9.0, 3.0, 25.0}, {-7.0, -4.0, -70.0}, {3.0, 5.0, 170.0}}};

std::vector<CameraPose> poses(const Case& what) {
    std::vector<CameraPose> result;
    Place middle = what.spike.apex;
    middle.height_m /= 2.0;
    for (std::size_t i = 0; i < kTurns.size(); ++i) {
        const double azimuth = what.eye_azimuths_deg[i % what.eye_azimuths_deg.size()];
        Place eye = moved(what.spike.apex, azimuth, what.way_m);
        eye.height_m = what.eye_height_m;
        CameraPose pose = looking_at(eye, ecef_of(middle));
        pose.vertical_fov_deg = what.fov_deg;
        pose.yaw_deg += kTurns[i][0] * what.fov_deg / kTurnsFovDeg;
        pose.pitch_deg += kTurns[i][1] * what.fov_deg / kTurnsFovDeg;
        pose.roll_deg = kTurns[i][2];
        result.push_back(pose);
    }
    return result;
}

/// The pyramid is what is nearer than the bare ellipsoid, by more than any rounding.
Coverage pyramid_in(const DrawnPicture& drawn, const ReferenceCamera& camera) {
    return [&drawn, &camera](int x, int y) {
        if (x < 0 || y < 0 || x >= drawn.picture.size.width_px || y >= drawn.picture.size.height_px)
            return false;
        const double distance_m = drawn.distance_at(x, y);
        const auto bare_m = camera.ellipsoid_distance_m({x + 0.5, y + 0.5}, 0.0);
        return distance_m > 0.0 && (!bare_m || distance_m < 0.99 * *bare_m);
    };
}

std::string words(const CameraPose& pose) {
    return "eye " + std::to_string(pose.place.latitude_deg) + " " + std::to_string(pose.place.longitude_deg) +
           " yaw " + std::to_string(pose.yaw_deg) + " pitch " + std::to_string(pose.pitch_deg) + " roll " +
           std::to_string(pose.roll_deg);
}

void PrintTo(const Case& what, std::ostream* out) { *out << what.name; }

class PointsToPixels : public ::testing::TestWithParam<Case> {};

TEST_P(PointsToPixels, AgreeWithThePlainProjectionWithinHalfAPixel) {
    const Case& what = GetParam();
    const ScratchFolder scratch;
    ig::SceneOptions options;
    options.sentinel = true;
    options.tau_px = kTauPx;
    Renderer renderer(make_spike_database(what.spike, scratch.path() / "terrain"), {1920, 1080}, options);
    double largest_px = 0.0;
    for (const CameraPose& pose : poses(what)) {
        SCOPED_TRACE(words(pose));
        const ReferenceCamera camera(pose);
        const auto [apex, one_end, other_end] = outline(what.spike, camera);
        const DrawnPicture drawn = renderer.draw_complete(pose);
        keep_for_looking(drawn.picture,
                         "points-" + what.name + "-" + std::to_string(static_cast<int>(pose.roll_deg)));
        const Coverage covers = pyramid_in(drawn, camera);
        const glm::dvec2 inside = (apex + one_end + other_end) / 3.0;
        const auto one = fit_edge(covers, apex, one_end, inside);
        const auto other = fit_edge(covers, apex, other_end, inside);
        ASSERT_TRUE(one.has_value()) << "no edge towards " << one_end.x << " " << one_end.y;
        ASSERT_TRUE(other.has_value()) << "no edge towards " << other_end.x << " " << other_end.y;
        const auto drawn_apex = crossing(*one, *other);
        ASSERT_TRUE(drawn_apex.has_value());
        const double error_px = glm::distance(*drawn_apex, apex);
        EXPECT_LE(error_px, kLargestErrorPx) << "drawn at " << drawn_apex->x << " " << drawn_apex->y
                                             << ", expected at " << apex.x << " " << apex.y;
        largest_px = std::max(largest_px, error_px);
    }
    std::printf("largest error %.3f px\n", largest_px);
}

INSTANTIATE_TEST_SUITE_P(Earth, PointsToPixels, ::testing::ValuesIn(all_cases()),
                         [](const auto& instance) { return instance.param.name; });

}  // namespace
}  // namespace eyepoint::testing
