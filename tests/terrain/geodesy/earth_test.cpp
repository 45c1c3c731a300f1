#include "terrain/geodesy/earth.hpp"

#include <cmath>

#include <GeographicLib/LocalCartesian.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace eyepoint::terrain {
namespace {

constexpr double kHalfTurn = 3.14159265358979323846;

void expect_near(const glm::dvec3& got, const glm::dvec3& want, double tolerance) {
    EXPECT_NEAR(got.x, want.x, tolerance);
    EXPECT_NEAR(got.y, want.y, tolerance);
    EXPECT_NEAR(got.z, want.z, tolerance);
}

TEST(Earth, KnownPointsOfTheEllipsoid) {
    expect_near(to_ecef({0.0, 0.0, EllipsoidalHeight{}}), {6378137.0, 0.0, 0.0}, 1e-6);
    expect_near(to_ecef({0.0, 90.0, EllipsoidalHeight{100.0}}), {0.0, 6378237.0, 0.0}, 1e-6);
    // Polar radius of WGS84: NIMA TR8350.2, table 3.3.
    expect_near(to_ecef({90.0, 0.0, EllipsoidalHeight{}}), {0.0, 0.0, 6356752.3142}, 1e-4);
}

TEST(Earth, GeodeticComesBackFromEcef) {
    for (const double latitude : {-89.999, -45.0, 0.0, 46.4, 90.0}) {
        for (const double height : {-400.0, 0.0, 10000.0, 400000.0}) {
            const Geodetic back = to_geodetic(to_ecef({latitude, 8.1, EllipsoidalHeight{height}}));
            EXPECT_NEAR(back.latitude_deg, latitude, 1e-12);
            EXPECT_NEAR(back.height.metres(), height, 1e-7);
        }
    }
}

TEST(Earth, EastNorthUpAgreesWithLocalCartesian) {
    for (const double latitude : {-60.0, 0.0, 46.4, 89.99}) {
        const GeographicLib::LocalCartesian local(latitude, 8.1, 0.0);
        const glm::dmat3 enu = east_north_up(latitude, 8.1);
        const Ecef origin = to_ecef({latitude, 8.1, EllipsoidalHeight{}});
        for (int axis = 0; axis < 3; ++axis) {
            glm::dvec3 reach{0.0};
            reach[axis] = 1000.0;
            double lat = 0, lon = 0, h = 0;
            local.Reverse(reach.x, reach.y, reach.z, lat, lon, h);
            const glm::dvec3 want = (to_ecef({lat, lon, EllipsoidalHeight{h}}) - origin) / 1000.0;
            expect_near(enu[axis], want, 1e-9);
        }
    }
}

TEST(Earth, BodyAxesFollowYawPitchRollInThatOrder) {
    const glm::dmat3 enu = east_north_up(46.4, 8.1);
    const glm::dvec3 east = enu[0], north = enu[1], up = enu[2];
    const auto level_north = body_axes(46.4, 8.1, {});
    expect_near(level_north[0], north, 1e-12);
    expect_near(level_north[1], east, 1e-12);
    expect_near(level_north[2], -up, 1e-12);
    // Heading east, nose 30 degrees up: forward is east and up.
    const auto climbing_east = body_axes(46.4, 8.1, {kHalfTurn / 2, kHalfTurn / 6, 0.0});
    expect_near(climbing_east[0], east * std::cos(kHalfTurn / 6) + up * 0.5, 1e-12);
    // Level north, 90 degrees of right bank: the right wing points down.
    expect_near(body_axes(46.4, 8.1, {0.0, 0.0, kHalfTurn / 2})[1], -up, 1e-12);
    // Nose straight up, then roll: the roll axis is the nose, so the right wing turns in the horizontal
    // plane.
    const auto rocket = body_axes(46.4, 8.1, {0.0, kHalfTurn / 2, kHalfTurn / 2});
    expect_near(rocket[0], up, 1e-12);
    expect_near(rocket[1], north, 1e-12);
}

}  // namespace
}  // namespace eyepoint::terrain
