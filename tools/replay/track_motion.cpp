#include "tools/replay/track_motion.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace eyepoint::tools {
namespace {

constexpr double kStandardGravity = 9.80665;
constexpr double kDegreesPerRadian = 180.0 / std::numbers::pi;
// Below this ground speed the course of a track log is mostly noise.
constexpr double kSlowMps = 3.0;
constexpr double kFastestTurnDegPerS = 60.0;

std::vector<Vector3> running_mean(const std::vector<Vector3>& values, std::size_t half_width) {
    std::vector<Vector3> sums(values.size() + 1);
    for (std::size_t i = 0; i < values.size(); ++i) {
        for (std::size_t axis = 0; axis < 3; ++axis) sums[i + 1][axis] = sums[i][axis] + values[i][axis];
    }
    std::vector<Vector3> means(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
        const std::size_t half = std::min({half_width, i, values.size() - 1 - i});
        const double count = static_cast<double>(2 * half + 1);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            means[i][axis] = (sums[i + half + 1][axis] - sums[i - half][axis]) / count;
        }
    }
    return means;
}

double ground_speed(const Motion& motion) {
    return std::hypot(motion.velocity_ned[0], motion.velocity_ned[1]);
}

double course_deg(const Motion& motion) {
    return std::atan2(motion.velocity_ned[1], motion.velocity_ned[0]) * kDegreesPerRadian;
}

double flight_path_deg(const Motion& motion) {
    const double speed = std::max(ground_speed(motion), kSlowMps);
    const double angle = std::atan2(-motion.velocity_ned[2], speed) * kDegreesPerRadian;
    return std::clamp(angle, -kMostPitchDeg, kMostPitchDeg);
}

// speed * course rate is the horizontal acceleration across the velocity.
double bank_deg(const Motion& motion) {
    const Vector3 &v = motion.velocity_ned, &a = motion.acceleration_ned;
    const double speed = ground_speed(motion);
    const double across = (v[0] * a[1] - v[1] * a[0]) / std::max(speed, kSlowMps);
    const double bank = std::atan2(across, kStandardGravity) * kDegreesPerRadian;
    return std::clamp(bank * std::min(1.0, speed / kSlowMps), -kMostBankDeg, kMostBankDeg);
}

double first_course_deg(std::span<const Motion> motions) {
    const auto moving = std::find_if(motions.begin(), motions.end(),
                                     [](const Motion& motion) { return ground_speed(motion) >= kSlowMps; });
    return moving == motions.end() ? 0.0 : course_deg(*moving);
}

}  // namespace

std::vector<Vector3> smoothed(std::vector<Vector3> values, double deviation_samples) {
    // A running mean of w samples has the variance (w^2 - 1) / 12; three of them add up to 3 (w^2 - 1) / 12.
    const double width = std::sqrt(4.0 * deviation_samples * deviation_samples + 1.0);
    const auto half_width = static_cast<std::size_t>(std::lround((width - 1.0) / 2.0));
    for (int pass = 0; pass < 3; ++pass) values = running_mean(values, half_width);
    return values;
}

std::vector<net::AttitudeDeg> coordinated_attitudes(std::span<const Motion> motions, double step_s) {
    std::vector<net::AttitudeDeg> attitudes;
    attitudes.reserve(motions.size());
    double yaw = first_course_deg(motions);
    for (const Motion& motion : motions) {
        const double most = kFastestTurnDegPerS * step_s * std::min(1.0, ground_speed(motion) / kSlowMps);
        yaw += std::clamp(std::remainder(course_deg(motion) - yaw, 360.0), -most, most);
        yaw = std::remainder(yaw, 360.0);
        attitudes.push_back({yaw < 0.0 ? yaw + 360.0 : yaw, flight_path_deg(motion), bank_deg(motion)});
    }
    return attitudes;
}

}  // namespace eyepoint::tools
