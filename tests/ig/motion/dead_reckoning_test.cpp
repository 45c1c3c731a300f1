#include "ig/motion/dead_reckoning.hpp"

#include <cmath>
#include <numbers>

#include <GeographicLib/Geodesic.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "terrain/geodesy/earth.hpp"

namespace eyepoint::ig {
namespace {

using net::EntityRates;
using net::EntityState;

EntityState at(double latitude_deg, double longitude_deg, net::AttitudeDeg attitude = {}) {
    return {.latitude_deg = latitude_deg,
            .longitude_deg = longitude_deg,
            .altitude_m = 0.0,
            .attitude = attitude};
}

terrain::Attitude radians(const net::AttitudeDeg& attitude) {
    return {glm::radians(attitude.yaw_deg), glm::radians(attitude.pitch_deg),
            glm::radians(attitude.roll_deg)};
}

glm::dmat3 axes(const EntityState& entity) {
    return terrain::body_axes(entity.latitude_deg, entity.longitude_deg, radians(entity.attitude));
}

double in(int thousandths, double low, double high) { return low + (high - low) * thousandths / 1000.0; }

RC_GTEST_PROP(DeadReckoning, EndsWhereTheGeodesicEnds, ()) {
    const double latitude = in(*rc::gen::inRange(0, 1000), -89.0, 89.0);
    const double longitude = in(*rc::gen::inRange(0, 1000), -180.0, 180.0);
    const double course = in(*rc::gen::inRange(0, 1000), 0.0, 360.0);
    const double speed = in(*rc::gen::inRange(0, 1000), 0.0, 1000.0);
    const glm::dvec3 ned = glm::dvec3(std::cos(glm::radians(course)), std::sin(glm::radians(course)), 0.0);
    const EntityState later = moved_on(at(latitude, longitude), {.ned_mps = ned * speed}, 0.2);
    double expected_latitude = 0.0, expected_longitude = 0.0, apart_m = 0.0;
    const auto& geodesic = GeographicLib::Geodesic::WGS84();
    geodesic.Direct(latitude, longitude, course, speed * 0.2, expected_latitude, expected_longitude);
    geodesic.Inverse(expected_latitude, expected_longitude, later.latitude_deg, later.longitude_deg, apart_m);
    // A tangent of 200 m leaves its end's foot 200^3 / (3 R^2) behind, 0.07 mm.
    RC_ASSERT(apart_m < 1e-4);
    RC_ASSERT(later.altitude_m == 0.0);
}

RC_GTEST_PROP(DeadReckoning, WayAndTurnBetweenTheEndsAreThoseGiven, ()) {
    const auto number = [](double low, double high) { return in(*rc::gen::inRange(0, 1001), low, high); };
    const EntityState from =
        at(number(-80, 80), number(-180, 180), {number(0, 360), number(-90, 90), number(-180, 180)});
    const Velocity velocity{{number(-300, 300), number(-300, 300), number(-50, 50)},
                            {number(-3, 3), number(-3, 3), number(-3, 3)}};
    const EntityState to = moved_on(from, velocity, 0.2);
    // North turns by way * tan(latitude) / R between the ends: 5e-5 of the way.
    RC_ASSERT(glm::length(way_between(from, to) - velocity.ned_mps * 0.2) < 0.01);
    RC_ASSERT(glm::length(turn_between(from, to) - velocity.turn_rad_s * 0.2) < 1e-6);
}

TEST(DeadReckoning, NoTimeGivesTheEntityBitForBit) {
    const EntityState entity = at(46.123456789, 8.987654321, {123.4, 5.6, -7.8});
    const EntityState same = moved_on(entity, {{100, 100, 1}, {1, 1, 1}}, 0.0);
    EXPECT_EQ(same.latitude_deg, entity.latitude_deg);
    EXPECT_EQ(same.longitude_deg, entity.longitude_deg);
    EXPECT_EQ(same.attitude, entity.attitude);
}

TEST(DeadReckoning, OverThePoleTheNoseKeepsItsDirectionInSpace) {
    const EntityState from = at(89.9999, 30.0);  // 11 m before it
    const EntityState to = moved_on(from, {.ned_mps = {100, 0, 0}}, 0.2);
    EXPECT_NEAR(to.longitude_deg, -150.0, 1e-6);
    EXPECT_NEAR(to.attitude.yaw_deg, 180.0, 1e-6);
    EXPECT_NEAR(glm::dot(axes(from)[0], axes(to)[0]), 1.0, 1e-9);
}

TEST(DeadReckoning, CrossesTheAntimeridian) {
    const EntityState to = moved_on(at(0.0, 179.9999), {.ned_mps = {0, 200, 0}}, 0.2);
    EXPECT_LT(to.longitude_deg, -179.9997);
    EXPECT_NEAR(to.attitude.yaw_deg, 0.0, 1e-9);
}

TEST(DeadReckoning, ClimbChangesTheAltitudeButNotAboveGround) {
    EntityState entity = at(46.0, 8.0);
    entity.altitude_m = 1000.0;
    EXPECT_NEAR(moved_on(entity, {.ned_mps = {0, 0, -10}}, 0.1).altitude_m, 1001.0, 1e-9);
    entity.above_ground = true;
    EXPECT_EQ(moved_on(entity, {.ned_mps = {0, 0, -10}}, 0.1).altitude_m, 1000.0);
}

TEST(DeadReckoning, StraightUpIsAnAttitudeLikeAnother) {
    const EntityState from = at(46.0, 8.0, {40.0, 90.0, 25.0});
    const EntityState to = moved_on(from, {.ned_mps = {1, 0, 0}}, 0.1);
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(glm::dot(axes(from)[axis], axes(to)[axis]), 1.0, 1e-9);
}

TEST(StatedVelocity, IsAbsentWhereTheHostStatesNone) {
    EXPECT_FALSE(stated_velocity(at(46.0, 8.0)).has_value());
}

/// The rates of yaw, pitch and roll, put onto the angles themselves, are the other way to the same attitude.
RC_GTEST_PROP(StatedVelocity, EulerRatesTurnAsTheAnglesThemselvesDo, ()) {
    const auto number = [](double low, double high) { return in(*rc::gen::inRange(0, 1001), low, high); };
    constexpr double kSeconds = 1e-3;
    EntityState from = at(46.0, 8.0, {number(0, 350), number(-70, 70), number(-170, 170)});
    const net::AttitudeDeg rates{number(-60, 60), number(-60, 60), number(-60, 60)};
    from.rates = EntityRates{.turn_deg_s = rates};
    EntityState expected = from;
    expected.attitude = {from.attitude.yaw_deg + rates.yaw_deg * kSeconds,
                         from.attitude.pitch_deg + rates.pitch_deg * kSeconds,
                         from.attitude.roll_deg + rates.roll_deg * kSeconds};
    const EntityState to = moved_on(from, *stated_velocity(from), kSeconds);
    RC_ASSERT(glm::length(turn_between(expected, to)) < 1e-5);  // of the order of (1 rad/s * 1 ms)^2
}

TEST(StatedVelocity, BodyAxesAreTurnedIntoNorthEastDown) {
    EntityState entity = at(46.0, 8.0, {90.0, 0.0, 90.0});  // to the east, right wing down
    entity.rates = EntityRates{.axes = EntityRates::Axes::Body,
                               .velocity_mps = {50.0, 3.0, 0.0},
                               .turn = EntityRates::Turn::AboutAxes,
                               .turn_deg_s = {.yaw_deg = 1.0, .pitch_deg = 2.0, .roll_deg = 3.0}};
    const auto velocity = *stated_velocity(entity);
    EXPECT_NEAR(glm::distance(velocity.ned_mps, glm::dvec3(0.0, 50.0, 3.0)), 0.0, 1e-9);
    EXPECT_NEAR(glm::distance(velocity.turn_rad_s, glm::radians(glm::dvec3(3.0, 2.0, 1.0))), 0.0, 1e-9);
    entity.rates->axes = EntityRates::Axes::NorthEastDown;
    const glm::dmat3 body_in_ned = terrain::attitude_rotation(radians(entity.attitude));
    const glm::dvec3 back = body_in_ned * stated_velocity(entity)->turn_rad_s;
    EXPECT_NEAR(glm::distance(back, glm::radians(glm::dvec3(3.0, 2.0, 1.0))), 0.0, 1e-9);
}

}  // namespace
}  // namespace eyepoint::ig
