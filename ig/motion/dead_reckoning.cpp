#include "ig/motion/dead_reckoning.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/trigonometric.hpp>

#include "terrain/geodesy/earth.hpp"

namespace eyepoint::ig {

terrain::Attitude attitude_of(const net::AttitudeDeg& attitude) {
    return {glm::radians(attitude.yaw_deg), glm::radians(attitude.pitch_deg),
            glm::radians(attitude.roll_deg)};
}

namespace {

/// Below this the nose points straight up or down and yaw and roll turn about one axis; the roll is then 0.
constexpr double kGimbalLock = 1e-9;

/// The altitude is taken for ellipsoidal: over a way this short the geoid does not matter.
terrain::Ecef place_of(const net::EntityState& entity) {
    return terrain::to_ecef(
        {entity.latitude_deg, entity.longitude_deg, terrain::EllipsoidalHeight{entity.altitude_m}});
}

glm::dmat3 axes_of(const net::EntityState& entity) {
    return terrain::body_axes(entity.latitude_deg, entity.longitude_deg, attitude_of(entity.attitude));
}

/// North, east, down unit vectors at the entity, in ECEF.
glm::dmat3 north_east_down(const net::EntityState& entity) {
    const glm::dmat3 enu = terrain::east_north_up(entity.latitude_deg, entity.longitude_deg);
    return {enu[1], enu[0], -enu[2]};
}

glm::dquat rotation_by(const glm::dvec3& turn_rad) {
    const double angle_rad = glm::length(turn_rad);
    return angle_rad > 0.0 ? glm::angleAxis(angle_rad, turn_rad / angle_rad) : glm::dquat(1.0, 0.0, 0.0, 0.0);
}

/// The least rotation that brings one place's vertical to the other's.
glm::dmat3 level_to_level(const glm::dmat3& from_ned, const glm::dmat3& to_ned) {
    const glm::dvec3 axis = glm::cross(from_ned[2], to_ned[2]);
    const double sine = glm::length(axis);
    if (sine <= 0.0) return glm::dmat3(1.0);
    return glm::mat3_cast(glm::angleAxis(std::atan2(sine, glm::dot(from_ned[2], to_ned[2])), axis / sine));
}

net::AttitudeDeg attitude_from(const glm::dmat3& body_in_ned) {
    const glm::dvec3 &forward = body_in_ned[0], &right = body_in_ned[1], &down = body_in_ned[2];
    net::AttitudeDeg attitude;
    attitude.pitch_deg = glm::degrees(std::asin(std::clamp(-forward.z, -1.0, 1.0)));
    double yaw_rad = std::atan2(-right.x, right.y);
    if (std::hypot(forward.x, forward.y) > kGimbalLock) {
        yaw_rad = std::atan2(forward.y, forward.x);
        attitude.roll_deg = glm::degrees(std::atan2(right.z, down.z));
    }
    attitude.yaw_deg = glm::degrees(yaw_rad < 0.0 ? yaw_rad + 2.0 * std::numbers::pi : yaw_rad);
    return attitude;
}

/// Rates of yaw, pitch and roll as a rate about the body axes.
glm::dvec3 about_body_axes(const glm::dvec3& roll_pitch_yaw_rates, const terrain::Attitude& attitude) {
    const auto [roll, pitch, yaw] =
        std::tuple{roll_pitch_yaw_rates.x, roll_pitch_yaw_rates.y, roll_pitch_yaw_rates.z};
    const double sin_roll = std::sin(attitude.roll_rad), cos_roll = std::cos(attitude.roll_rad);
    const double cos_pitch = std::cos(attitude.pitch_rad);
    return {roll - yaw * std::sin(attitude.pitch_rad), pitch * cos_roll + yaw * cos_pitch * sin_roll,
            yaw * cos_pitch * cos_roll - pitch * sin_roll};
}

}  // namespace

std::optional<Velocity> stated_velocity(const net::EntityState& entity) {
    if (!entity.rates) return std::nullopt;
    const net::EntityRates& rates = *entity.rates;
    const terrain::Attitude attitude = attitude_of(entity.attitude);
    const glm::dmat3 body_in_ned = terrain::attitude_rotation(attitude);
    const bool in_body_axes = rates.axes == net::EntityRates::Axes::Body;
    const glm::dvec3 along{rates.velocity_mps[0], rates.velocity_mps[1], rates.velocity_mps[2]};
    const glm::dvec3 turn = glm::radians(
        glm::dvec3(rates.turn_deg_s.roll_deg, rates.turn_deg_s.pitch_deg, rates.turn_deg_s.yaw_deg));
    Velocity velocity{in_body_axes ? body_in_ned * along : along, turn};
    if (rates.turn == net::EntityRates::Turn::EulerAngles) {
        velocity.turn_rad_s = about_body_axes(turn, attitude);
    } else if (!in_body_axes) {
        velocity.turn_rad_s = glm::transpose(body_in_ned) * turn;
    }
    return velocity;
}

glm::dvec3 way_between(const net::EntityState& from, const net::EntityState& to) {
    glm::dvec3 way = glm::transpose(north_east_down(to)) * (place_of(to) - place_of(from));
    way.z = from.altitude_m - to.altitude_m;
    return way;
}

glm::dvec3 turn_between(const net::EntityState& from, const net::EntityState& to) {
    const glm::dmat3 carried = level_to_level(north_east_down(from), north_east_down(to)) * axes_of(from);
    glm::dquat turn = glm::quat_cast(glm::transpose(carried) * axes_of(to));
    if (turn.w < 0.0) turn = -turn;
    const glm::dvec3 axis(turn.x, turn.y, turn.z);
    const double sine = glm::length(axis);
    return sine > 0.0 ? axis * (2.0 * std::atan2(sine, turn.w) / sine) : glm::dvec3(0.0);
}

net::EntityState moved_on(const net::EntityState& entity, const Velocity& velocity, double seconds) {
    if (seconds == 0.0) return entity;
    const glm::dmat3 from_ned = north_east_down(entity);
    const glm::dvec3 level(velocity.ned_mps.x, velocity.ned_mps.y, 0.0);
    const terrain::Geodetic place = terrain::to_geodetic(place_of(entity) + from_ned * level * seconds);
    net::EntityState later = entity;
    later.latitude_deg = place.latitude_deg;
    later.longitude_deg = place.longitude_deg;
    if (!entity.above_ground) later.altitude_m -= velocity.ned_mps.z * seconds;
    const glm::dmat3 to_ned = north_east_down(later);
    const glm::dmat3 turned = axes_of(entity) * glm::mat3_cast(rotation_by(velocity.turn_rad_s * seconds));
    later.attitude = attitude_from(glm::transpose(to_ned) * level_to_level(from_ned, to_ned) * turned);
    return later;
}

}  // namespace eyepoint::ig
