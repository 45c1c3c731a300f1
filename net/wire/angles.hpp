/// Angles of the wire brought into their ranges.
#pragma once

#include <cmath>

namespace eyepoint::net::wire {

/// Any finite angle in degrees to 0 <= yaw < 360.
[[nodiscard]] inline double turn_0_360(double angle_deg) {
    const double turned = std::remainder(angle_deg, 360.0);
    const double positive = turned < 0.0 ? turned + 360.0 : turned;
    return positive < 360.0 ? positive : 0.0;
}

/// Any finite angle in degrees to -180 <= angle <= 180.
[[nodiscard]] inline double turn_180(double angle_deg) { return std::remainder(angle_deg, 360.0); }

}  // namespace eyepoint::net::wire
