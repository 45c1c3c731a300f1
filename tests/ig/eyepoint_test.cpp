#include "ig/eyepoint.hpp"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

#include <GeographicLib/Geocentric.hpp>
#include <GeographicLib/LocalCartesian.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace eyepoint::ig {
namespace {

constexpr PictureSize kSize{1280, 720};
/// Unit vectors from sines and cosines of a few angles: some roundings of 1.1e-16 each.
constexpr double kAxisError = 1e-14;
/// Positions of 6.4e6 m in double: some roundings of 0.93e-9 m each.
constexpr double kPositionErrorM = 1e-8;

double radians(double degrees) { return degrees * std::numbers::pi / 180.0; }

net::HostState host_at(const net::EntityState& ownship) {
    net::HostState state;
    state.entities[0] = ownship;
    return state;
}

EyepointReading on_ellipsoid(const config::ViewSettings& view = {}) {
    return {view, config::VerticalDatum::Ellipsoid, nullptr};
}

Eyepoint eye_of(const net::EntityState& ownship, const config::ViewSettings& view = {}) {
    return eyepoint_of(host_at(ownship), on_ellipsoid(view), kSize).value();
}

/// Where a step of metres along east, north and up leads, in ECEF, by GeographicLib::LocalCartesian: the
/// direction's independent source.
glm::dvec3 step(const net::EntityState& from, double east, double north, double up) {
    const GeographicLib::LocalCartesian local(from.latitude_deg, from.longitude_deg, from.altitude_m);
    double latitude_deg = 0.0, longitude_deg = 0.0, height_m = 0.0;
    local.Reverse(east, north, up, latitude_deg, longitude_deg, height_m);
    glm::dvec3 point;
    GeographicLib::Geocentric::WGS84().Forward(latitude_deg, longitude_deg, height_m, point.x, point.y,
                                               point.z);
    return point;
}

void expect_near(const glm::dvec3& actual, const glm::dvec3& expected, double error) {
    EXPECT_NEAR(actual.x, expected.x, error);
    EXPECT_NEAR(actual.y, expected.y, error);
    EXPECT_NEAR(actual.z, expected.z, error);
}

TEST(Eyepoint, IsAbsentUntilTheHostHasPlacedTheVehicle) {
    EXPECT_FALSE(eyepoint_of(net::HostState{}, on_ellipsoid(), kSize).has_value());
}

TEST(Eyepoint, AtTheEquatorAndPrimeMeridianLevelNorthTheAxesAreTheEarths) {
    const Eyepoint eye =
        eye_of({.latitude_deg = 0.0, .longitude_deg = 0.0, .altitude_m = 100.0, .attitude = {}});
    expect_near(eye.view.eye_ecef, {6378237.0, 0.0, 0.0}, kPositionErrorM);
    expect_near(eye.view.axes[0], {0.0, 1.0, 0.0}, kAxisError);   // right is east
    expect_near(eye.view.axes[1], {1.0, 0.0, 0.0}, kAxisError);   // up is away from the centre
    expect_near(eye.view.axes[2], {0.0, 0.0, -1.0}, kAxisError);  // backward is south
}

struct AttitudeCase {
    std::string name;
    net::EntityState ownship;
};

/// Names the cases in test output.
void PrintTo(const AttitudeCase& attitude_case, std::ostream* out) { *out << attitude_case.name; }

class EyepointAttitude : public testing::TestWithParam<AttitudeCase> {};

// The nose of a vehicle with yaw psi and pitch theta points cos(theta) sin(psi) east, cos(theta) cos(psi)
// north and sin(theta) up; its right wing at roll phi follows from turning about that nose.
TEST_P(EyepointAttitude, NoseAndRightWingPointWhereTheAnglesSay) {
    const net::EntityState ownship = GetParam().ownship;
    const double yaw = radians(ownship.attitude.yaw_deg), pitch = radians(ownship.attitude.pitch_deg),
                 roll = radians(ownship.attitude.roll_deg);
    constexpr double kStepM = 1000.0;
    const glm::dvec3 eye = step(ownship, 0.0, 0.0, 0.0);
    const auto direction = [&](double east, double north, double up) {
        return (step(ownship, kStepM * east, kStepM * north, kStepM * up) - eye) / kStepM;
    };
    const glm::dvec3 nose =
        direction(std::cos(pitch) * std::sin(yaw), std::cos(pitch) * std::cos(yaw), std::sin(pitch));
    const glm::dvec3 level_right = direction(std::cos(yaw), -std::sin(yaw), 0.0);
    const glm::dvec3 right = std::cos(roll) * level_right + std::sin(roll) * glm::cross(nose, level_right);

    constexpr double kStepError = 1e-11;  // two positions of 1e-9 m over a step of 1000 m
    const View view = eye_of(ownship).view;
    expect_near(view.eye_ecef, eye, 10 * kPositionErrorM);
    expect_near(-view.axes[2], nose, kStepError);
    expect_near(view.axes[0], right, kStepError);
    expect_near(view.axes[1], glm::cross(right, nose), kStepError);
}

INSTANTIATE_TEST_SUITE_P(
    Places, EyepointAttitude,
    testing::Values(AttitudeCase{"equator", {0.0, 20.0, 300.0, {90.0, 10.0, 0.0}}},
                    AttitudeCase{"sixty_north", {60.0, 25.0, 3000.0, {215.0, -12.0, 35.0}}},
                    AttitudeCase{"near_north_pole", {89.9999, 100.0, 500.0, {45.0, 5.0, -60.0}}},
                    AttitudeCase{"south_pole", {-90.0, 0.0, 2835.0, {180.0, 0.0, 10.0}}},
                    AttitudeCase{"antimeridian_west", {-17.0, -180.0, 50.0, {270.0, 0.0, 0.0}}},
                    AttitudeCase{"antimeridian_east", {52.0, 179.99999, 50.0, {90.0, 30.0, 170.0}}},
                    AttitudeCase{"straight_up", {46.4, 8.1, 4000.0, {10.0, 90.0, 0.0}}}),
    [](const auto& attitude_case) { return attitude_case.param.name; });

RC_GTEST_PROP(EyepointProperty, AxesAreARotationEverywhere, ()) {
    const auto angle = [](int limit) { return *rc::gen::inRange(-limit * 1000, limit * 1000 + 1) / 1000.0; };
    const View view = eye_of({angle(90), angle(180), angle(9000), {angle(360), angle(90), angle(180)}}).view;
    RC_ASSERT(std::abs(glm::determinant(view.axes) - 1.0) < kAxisError);
    RC_ASSERT(std::abs(glm::dot(view.axes[0], view.axes[1])) < kAxisError);
    RC_ASSERT(std::abs(glm::dot(view.axes[1], view.axes[2])) < kAxisError);
}

TEST(Eyepoint, OffsetMovesTheEyeAlongTheBodyAxes) {
    // Heading east on the equator at 90 E: forward is -x, right is south (-z), down is -y.
    config::ViewSettings settings;
    settings.eye_forward_m = 3.0;
    settings.eye_right_m = 2.0;
    settings.eye_down_m = -1.5;
    const Eyepoint eye = eye_of({0.0, 90.0, 0.0, {90.0, 0.0, 0.0}}, settings);
    expect_near(eye.view.eye_ecef, {-3.0, 6378137.0 + 1.5, -2.0}, kPositionErrorM);
    EXPECT_NEAR(eye.place.height.metres(), 1.5, 1e-5);  // the Earth falls away by micrometres over 3.6 m
}

TEST(Eyepoint, ViewYawTurnsTheViewRightAboutTheBodysDownAxis) {
    config::ViewSettings settings;
    settings.yaw_deg = 90.0;
    const View view = eye_of({0.0, 0.0, 0.0, {0.0, 0.0, 0.0}}, settings).view;
    expect_near(-view.axes[2], {0.0, 1.0, 0.0}, kAxisError);  // looks east
    expect_near(view.axes[1], {1.0, 0.0, 0.0}, kAxisError);
}

TEST(Eyepoint, ViewPitchAndRollFollowTheTurnedAxes) {
    // Yaw right, then nose up, then roll right: looks east and 30 degrees up, the right side to the south and
    // down.
    config::ViewSettings settings;
    settings.yaw_deg = 90.0;
    settings.pitch_deg = 30.0;
    settings.roll_deg = 90.0;
    const View view = eye_of({0.0, 0.0, 0.0, {}}, settings).view;
    expect_near(-view.axes[2], {0.5, std::sqrt(0.75), 0.0}, kAxisError);
    expect_near(view.axes[1], {0.0, 0.0, -1.0}, kAxisError);
}

TEST(Eyepoint, TheHostsViewComesBeforeTheChannelsOwn) {
    net::HostState state = host_at({0.0, 0.0, 0.0, {}});
    state.views[3].attitude.pitch_deg = 90.0;  // straight up
    config::ViewSettings settings;
    settings.cigi_view = 3;
    settings.yaw_deg = 90.0;  // then right: about the host's view's own down axis, to the east
    const View view = eyepoint_of(state, on_ellipsoid(settings), kSize)->view;
    expect_near(-view.axes[2], {0.0, 1.0, 0.0}, kAxisError);
    expect_near(view.axes[1], {0.0, 0.0, -1.0}, kAxisError);
}

TEST(Eyepoint, AViewStandsOnTheEntityThatTheHostNames) {
    net::HostState state = host_at({0.0, 0.0, 0.0, {}});
    state.entities[7] = {10.0, 20.0, 30.0, {}};
    state.views[0].entity_id = 7;
    const Eyepoint eye = eyepoint_of(state, on_ellipsoid(), kSize).value();
    EXPECT_NEAR(eye.place.latitude_deg, 10.0, 1e-12);
    EXPECT_NEAR(eye.place.longitude_deg, 20.0, 1e-12);
    state.views[0].entity_id = 8;
    EXPECT_FALSE(eyepoint_of(state, on_ellipsoid(), kSize).has_value());
}

TEST(Eyepoint, FieldOfViewOfTheSettingsIsVerticalAndPixelsAreSquare) {
    config::ViewSettings settings;
    settings.vertical_fov_deg = 90.0;
    const View view = eye_of({0.0, 0.0, 0.0, {}}, settings).view;
    EXPECT_NEAR(view.top, 1.0, kAxisError);
    EXPECT_NEAR(view.bottom, -1.0, kAxisError);
    EXPECT_NEAR(view.right, 1280.0 / 720.0, kAxisError);
    EXPECT_NEAR(view.left, -1280.0 / 720.0, kAxisError);
    EXPECT_EQ(view.width_px, 1280);
    EXPECT_EQ(view.height_px, 720);
}

TEST(Eyepoint, HostsHalfAnglesBecomeTangentsAndTheRestStays) {
    net::HostState state = host_at({0.0, 0.0, 0.0, {}});
    state.views[0].left_deg = -60.0;
    state.views[0].right_deg = 30.0;
    state.views[0].near_m = 2.0;
    config::ViewSettings settings;
    settings.vertical_fov_deg = 90.0;
    const View view = eyepoint_of(state, on_ellipsoid(settings), kSize)->view;
    EXPECT_NEAR(view.left, -std::sqrt(3.0), kAxisError);
    EXPECT_NEAR(view.right, 1.0 / std::sqrt(3.0), kAxisError);
    EXPECT_NEAR(view.top, 1.0, kAxisError);
    EXPECT_EQ(view.near_m, 2.0);
}

TEST(Eyepoint, AHalfAngleOfNinetyDegreesIsDrawnFinite) {
    net::HostState state = host_at({0.0, 0.0, 0.0, {}});
    state.views[0].left_deg = -90.0;
    state.views[0].right_deg = 90.0;
    const View view = eyepoint_of(state, on_ellipsoid(), kSize)->view;
    EXPECT_NEAR(view.right, 57.29, 0.01);  // tan 89 degrees
    EXPECT_NEAR(view.left, -57.29, 0.01);
}

/// A geoid grid in GeographicLib's PGM form that is `undulation_m` everywhere; ten-degree posts.
std::filesystem::path write_constant_geoid(int undulation_m) {
    const auto file = std::filesystem::path(testing::TempDir()) / "constant-geoid.pgm";
    constexpr int kWidth = 36, kHeight = 19, kOffset = -200;
    std::ofstream out(file, std::ios::binary);
    out << "P5\n# Description constant\n# Offset " << kOffset << "\n# Scale 1\n"
        << kWidth << ' ' << kHeight << "\n65535\n";
    const int level = undulation_m - kOffset;
    for (int post = 0; post < kWidth * kHeight; ++post)
        out << static_cast<char>(level >> 8) << static_cast<char>(level);
    return file;
}

TEST(Eyepoint, MslAltitudeIsRaisedByTheGeoid) {
    const auto geoid = terrain::Geoid::load(write_constant_geoid(52));
    ASSERT_TRUE(geoid.has_value()) << geoid.error();
    const net::HostState state = host_at({46.4, 8.1, 3000.0, {}});
    const EyepointReading msl{{}, config::VerticalDatum::Msl, &*geoid};
    EXPECT_NEAR(eyepoint_of(state, msl, kSize)->place.height.metres(), 3052.0, 1e-6);
    EXPECT_NEAR(eyepoint_of(state, on_ellipsoid(), kSize)->place.height.metres(), 3000.0, 1e-6);
}

TEST(NeutralView, LooksLevelToTheNorth) {
    const View view = neutral_view({0.0, 0.0, terrain::EllipsoidalHeight{10.0}}, {}, kSize);
    expect_near(-view.axes[2], {0.0, 0.0, 1.0}, kAxisError);
    expect_near(view.eye_ecef, {6378147.0, 0.0, 0.0}, kPositionErrorM);
}

}  // namespace
}  // namespace eyepoint::ig
