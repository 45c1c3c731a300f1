/// Attitude from motion: how a vehicle that flies its track in coordinated turns is held.
#pragma once

#include <span>
#include <vector>

#include "net/host_state.hpp"
#include "tools/replay/track_curve.hpp"

namespace eyepoint::tools {

inline constexpr double kMostBankDeg = 60.0;
inline constexpr double kMostPitchDeg = 45.0;

/// Moves each value to the mean of its surroundings: three running means, near to a Gaussian of the standard
/// deviation given in samples, without delay; the window shrinks towards the ends.
[[nodiscard]] std::vector<Vector3> smoothed(std::vector<Vector3> values, double deviation_samples);

/// Velocity and acceleration against the Earth, in north, east, down of the place, m/s and m/s2.
struct Motion {
    Vector3 velocity_ned;
    Vector3 acceleration_ned;
};

/// Attitudes of a row of motions, `step_s` apart. Yaw: the course, turned at most 60 degrees a second, and
/// less below 3 m/s, so that a vehicle at rest keeps its heading. Pitch: the flight-path angle, within
/// kMostPitchDeg. Roll: the bank of a coordinated turn, tan(roll) = speed * course rate / g, within
/// kMostBankDeg and fading out below 3 m/s.
[[nodiscard]] std::vector<net::AttitudeDeg> coordinated_attitudes(std::span<const Motion> motions,
                                                                  double step_s);

}  // namespace eyepoint::tools
