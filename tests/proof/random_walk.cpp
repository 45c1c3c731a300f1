#include "tests/proof/random_walk.hpp"

#include <cmath>

#include <glm/geometric.hpp>

#include "terrain/geodesy/earth.hpp"

namespace eyepoint::testing {

namespace {

constexpr double kPi = 3.14159265358979323846;

struct Ground {
    double latitude_deg = 0.0, longitude_deg = 0.0;
};

/// East and north of a place, in degrees of a great circle.
Ground ground_at(const AnalyticTerrain& terrain, double east_deg, double north_deg) {
    if (std::abs(terrain.latitude_deg) == 90.0) {
        return {std::copysign(90.0 - std::hypot(east_deg, north_deg), terrain.latitude_deg),
                std::atan2(east_deg, north_deg) * 180.0 / kPi};
    }
    const double latitude_deg = terrain.latitude_deg + north_deg;
    return {latitude_deg,
            std::remainder(terrain.longitude_deg + east_deg / std::cos(latitude_deg * kPi / 180.0), 360.0)};
}

/// 60 by 45 degrees, 640 x 480 pixels.
terrain::LodView view_along(const terrain::Ecef& eye, const glm::dvec3& forward, const glm::dvec3& right) {
    const double top = std::tan(kPi / 8.0), side = top * 640.0 / 480.0;
    const glm::dvec3 up = glm::cross(right, forward);
    return {.eye = eye,
            .sides = {glm::normalize(right + forward * side), glm::normalize(-right + forward * side),
                      glm::normalize(up + forward * top), glm::normalize(-up + forward * top)},
            .kappa_px = 480.0 / (2.0 * top),
            .near_m = 0.5};
}

}  // namespace

void RandomWalk::begin_leg() {
    enum Kind { Low, Down, Turning, Jumping };
    const auto kind = static_cast<Kind>((views_ / kLegViews) % 4);
    const double reach_deg = terrain_.half_size_deg;
    east_deg_ = reach_deg * (1.4 * unit() - 0.7);
    north_deg_ = reach_deg * (1.4 * unit() - 0.7);
    // Through the middle, which is the line or the pole to be crossed, in the middle of the leg.
    const double stride = 2.0 * (kind == Jumping ? 1.0 : 0.1 * unit()) / kLegViews;
    east_step_deg_ = -east_deg_ * stride;
    north_step_deg_ = -north_deg_ * stride;
    if (kind != Jumping) {
        east_deg_ *= 0.05;
        north_deg_ *= 0.05;
        east_step_deg_ *= 0.05;
        north_step_deg_ *= 0.05;
    }
    above_m_ = kind == Low ? 2.0 * std::pow(20.0, unit()) : 200.0 * std::pow(60.0, unit());
    course_rad_ = 2.0 * kPi * unit();
    course_step_rad_ = kind == Turning ? 0.7 + unit() : 0.02 * unit();
    down_rad_ = kind == Down ? kPi / 2.0 : 0.6 * unit() - 0.05;
    roll_rad_ = kind == Turning ? unit() - 0.5 : 0.0;
}

terrain::LodView RandomWalk::next(double tau_px, double slack_px) {
    if (views_ % kLegViews == 0) begin_leg();
    const Ground ground = ground_at(terrain_, east_deg_, north_deg_);
    const double ground_m = analytic_height_m(terrain_, ground.latitude_deg, ground.longitude_deg);
    const glm::dmat3 enu = terrain::east_north_up(ground.latitude_deg, ground.longitude_deg);
    const glm::dvec3 ahead = enu[0] * std::sin(course_rad_) + enu[1] * std::cos(course_rad_);
    const glm::dvec3 level_right = enu[0] * std::cos(course_rad_) - enu[1] * std::sin(course_rad_);
    const glm::dvec3 forward = ahead * std::cos(down_rad_) - enu[2] * std::sin(down_rad_);
    const glm::dvec3 right =
        level_right * std::cos(roll_rad_) + glm::cross(forward, level_right) * std::sin(roll_rad_);
    terrain::LodView view = view_along(terrain::to_ecef({ground.latitude_deg, ground.longitude_deg,
                                                         terrain::EllipsoidalHeight{ground_m + above_m_}}),
                                       forward, right);
    view.tau_px = tau_px;
    view.slack_px = slack_px;
    ++views_;
    east_deg_ += east_step_deg_;
    north_deg_ += north_step_deg_;
    course_rad_ += course_step_rad_;
    return view;
}

std::vector<terrain::LodView> RandomWalk::views(std::size_t count, double tau_px, double slack_px) {
    std::vector<terrain::LodView> views;
    for (std::size_t i = 0; i < count; ++i) views.push_back(next(tau_px, slack_px));
    return views;
}

}  // namespace eyepoint::testing
