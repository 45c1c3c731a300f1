/// Dead reckoning: an entity moved on by its velocity, on the WGS84 ellipsoid. Pure values.
#pragma once

#include <optional>

#include <glm/vec3.hpp>

#include "net/host_state.hpp"
#include "terrain/geodesy/earth.hpp"

namespace eyepoint::ig {

/// The same angles in radians.
[[nodiscard]] terrain::Attitude attitude_of(const net::AttitudeDeg& attitude);

/// How an entity moves at one moment.
struct Velocity {
    glm::dvec3 ned_mps{0.0};     ///< north, east, down at the entity
    glm::dvec3 turn_rad_s{0.0};  ///< about its body axes (forward, right, down), right-handed
};

/// What the entity's host states; none where it states nothing. The rates of Euler angles are turned into
/// rates about the body axes (Stevens and Lewis, Aircraft Control and Simulation, the kinematic equations).
[[nodiscard]] std::optional<Velocity> stated_velocity(const net::EntityState& entity);

/// The way from one place to another in the north, east, down axes of the second, metres: a chord, for ways
/// that are short beside the Earth.
[[nodiscard]] glm::dvec3 way_between(const net::EntityState& from, const net::EntityState& to);

/// The turn from one attitude to another about the body axes, radians, at most pi; what the level plane tips
/// on the way, because the Earth is round, is no turn.
[[nodiscard]] glm::dvec3 turn_between(const net::EntityState& from, const net::EntityState& to);

/// The entity `seconds` later (may be negative), all else unchanged. It moves along the level plane of its
/// place and keeps to the ellipsoid's curve (over 2 km, within 0.2 m of a geodesic's end); its altitude
/// changes by the vertical velocity alone, and not at all where it is above ground, which is looked up at
/// the new place. The turn goes about fixed body axes. 0 seconds gives the entity itself, bit for bit.
[[nodiscard]] net::EntityState moved_on(const net::EntityState& entity, const Velocity& velocity,
                                        double seconds);

}  // namespace eyepoint::ig
