#include "tests/picture/reference_camera.hpp"

#include <cmath>
#include <numbers>

#include <GeographicLib/Geocentric.hpp>
#include <GeographicLib/Geodesic.hpp>
#include <glm/geometric.hpp>

namespace eyepoint::testing {

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

struct NorthEastDown {
    glm::dvec3 north, east, down;
};

NorthEastDown north_east_down(const Place& place) {
    const double lat = place.latitude_deg * kDegree, lon = place.longitude_deg * kDegree;
    return {{-std::sin(lat) * std::cos(lon), -std::sin(lat) * std::sin(lon), std::cos(lat)},
            {-std::sin(lon), std::cos(lon), 0.0},
            {-std::cos(lat) * std::cos(lon), -std::cos(lat) * std::sin(lon), -std::sin(lat)}};
}

glm::dvec3 inverse_squares(double height_m) {
    const double equatorial = GeographicLib::Constants::WGS84_a() + height_m;
    const double polar =
        GeographicLib::Constants::WGS84_a() * (1.0 - GeographicLib::Constants::WGS84_f()) + height_m;
    return {1.0 / (equatorial * equatorial), 1.0 / (equatorial * equatorial), 1.0 / (polar * polar)};
}

}  // namespace

glm::dvec3 ecef_of(const Place& place) {
    glm::dvec3 point;
    GeographicLib::Geocentric::WGS84().Forward(place.latitude_deg, place.longitude_deg, place.height_m,
                                               point.x, point.y, point.z);
    return point;
}

Place moved(const Place& from, double azimuth_deg, double distance_m) {
    Place to = from;
    GeographicLib::Geodesic::WGS84().Direct(from.latitude_deg, from.longitude_deg, azimuth_deg, distance_m,
                                            to.latitude_deg, to.longitude_deg);
    return to;
}

CameraPose looking_at(const Place& eye, const glm::dvec3& target_ecef) {
    const NorthEastDown local = north_east_down(eye);
    const glm::dvec3 way = target_ecef - ecef_of(eye);
    const double north = glm::dot(way, local.north), east = glm::dot(way, local.east);
    return {.place = eye,
            .yaw_deg = std::atan2(east, north) / kDegree,
            .pitch_deg = std::atan2(-glm::dot(way, local.down), std::hypot(north, east)) / kDegree};
}

ReferenceCamera::ReferenceCamera(const CameraPose& pose)
    : eye_(ecef_of(pose.place)),
      centre_px_(pose.width_px / 2.0, pose.height_px / 2.0),
      kappa_px_(pose.height_px / 2.0 / std::tan(pose.vertical_fov_deg / 2.0 * kDegree)) {
    const NorthEastDown local = north_east_down(pose.place);
    const double cy = std::cos(pose.yaw_deg * kDegree), sy = std::sin(pose.yaw_deg * kDegree);
    const double cp = std::cos(pose.pitch_deg * kDegree), sp = std::sin(pose.pitch_deg * kDegree);
    const double cr = std::cos(pose.roll_deg * kDegree), sr = std::sin(pose.roll_deg * kDegree);
    // Columns of Rz(yaw) Ry(pitch) Rx(roll), each combined from north, east and down.
    forward_ = cy * cp * local.north + sy * cp * local.east - sp * local.down;
    right_ =
        (cy * sp * sr - sy * cr) * local.north + (sy * sp * sr + cy * cr) * local.east + cp * sr * local.down;
    down_ =
        (cy * sp * cr + sy * sr) * local.north + (sy * sp * cr - cy * sr) * local.east + cp * cr * local.down;
}

std::optional<glm::dvec2> ReferenceCamera::project(const glm::dvec3& ecef) const {
    const glm::dvec3 way = ecef - eye_;
    const double along = glm::dot(way, forward_);
    if (along <= 0.0) return std::nullopt;
    return centre_px_ + kappa_px_ / along * glm::dvec2{glm::dot(way, right_), glm::dot(way, down_)};
}

glm::dvec3 ReferenceCamera::ray(const glm::dvec2& pixel) const {
    const glm::dvec2 tangent = (pixel - centre_px_) / kappa_px_;
    return forward_ + tangent.x * right_ + tangent.y * down_;
}

glm::dvec2 ReferenceCamera::image_direction(const glm::dvec2& pixel, const glm::dvec3& displacement) const {
    const glm::dvec2 across{glm::dot(displacement, right_), glm::dot(displacement, down_)};
    const glm::dvec2 tangent = (pixel - centre_px_) / kappa_px_;
    return kappa_px_ * (across - tangent * glm::dot(displacement, forward_));
}

std::optional<double> ReferenceCamera::ellipsoid_distance_m(const glm::dvec2& pixel, double height_m) const {
    const glm::dvec3 direction = ray(pixel), weights = inverse_squares(height_m);
    const double inward = -glm::dot(direction * weights, eye_);
    const double discriminant = ellipsoid_discriminant(pixel, height_m);
    if (discriminant < 0.0 || inward <= 0.0) return std::nullopt;
    // The nearer root in the form that does not cancel.
    return (glm::dot(eye_ * weights, eye_) - 1.0) / (inward + std::sqrt(discriminant));
}

double ReferenceCamera::ellipsoid_discriminant(const glm::dvec2& pixel, double height_m) const {
    const glm::dvec3 direction = ray(pixel), weights = inverse_squares(height_m);
    const double inward = -glm::dot(direction * weights, eye_);
    const double outside = glm::dot(eye_ * weights, eye_) - 1.0;
    return inward * inward - glm::dot(direction * weights, direction) * outside;
}

}  // namespace eyepoint::testing
