/// The WGS84 Earth: conversions and local frames, all through GeographicLib.
/// Thread use: every function is pure and may be called from any thread.
#pragma once

#include <numbers>

#include <glm/mat3x3.hpp>

#include "terrain/geodesy/position.hpp"

namespace eyepoint::terrain {

/// WGS84 equatorial radius, metres, and flattening (NIMA TR8350.2, table 3.1).
inline constexpr double kEquatorialRadiusM = 6378137.0;
inline constexpr double kFlattening = 1.0 / 298.257223563;
inline constexpr double kPolarRadiusM = kEquatorialRadiusM * (1.0 - kFlattening);
/// Along the equator; of latitude within 0.7%.
inline constexpr double kMetresPerDegree = kEquatorialRadiusM * std::numbers::pi / 180.0;

/// Geodetic to ECEF; error under 10 nm within 1000 km of the surface (GeographicLib::Geocentric).
[[nodiscard]] Ecef to_ecef(const Geodetic& place);

/// ECEF to geodetic; longitude in -180..180. At the poles longitude is 0, at the Earth's centre latitude
/// is 90.
[[nodiscard]] Geodetic to_geodetic(const Ecef& point);

/// Attitude against the local north-east-down frame, radians: yaw clockwise from true north, pitch nose up,
/// roll right wing down; applied yaw, then pitch, then roll, each about the axes already turned.
struct Attitude {
    double yaw_rad = 0.0;
    double pitch_rad = 0.0;
    double roll_rad = 0.0;
};

/// East, north and up unit vectors at a place, in ECEF; the columns of the matrix, in that order.
/// At a pole, the directions are those reached along the given longitude.
[[nodiscard]] glm::dmat3 east_north_up(double latitude_deg, double longitude_deg);

/// Body axes of a vehicle in ECEF: columns are X forward, Y right, Z down.
[[nodiscard]] glm::dmat3 body_axes(double latitude_deg, double longitude_deg, const Attitude& attitude);

/// The rotation of an attitude alone: columns are the body axes in the frame it is measured against (for the
/// local frame north, east, down; for a view, the vehicle's body axes).
[[nodiscard]] glm::dmat3 attitude_rotation(const Attitude& attitude);

}  // namespace eyepoint::terrain
