#include "terrain/tiling/tile_bounds.hpp"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "terrain/geodesy/earth.hpp"

namespace eyepoint::terrain {

namespace {

constexpr int kSamples = 5;  // an axis

glm::dvec3 unit_sphere_space(const Ecef& point) {
    return {point.x / kEquatorialRadiusM, point.y / kEquatorialRadiusM, point.z / kPolarRadiusM};
}

/// The five fractions 0, 1/4 .. 1 across a tile, as a place.
Geodetic sample_place(const GeographicExtent& area, int row, int column, double height_m) {
    const double north = static_cast<double>(row) / (kSamples - 1);
    const double east = static_cast<double>(column) / (kSamples - 1);
    return {area.south_deg + (area.north_deg - area.south_deg) * north,
            area.west_deg + (area.east_deg - area.west_deg) * east, EllipsoidalHeight{height_m}};
}

/// How far a surface of the Earth's curvature can rise above the plane of samples this far apart: the sagitta
/// of the arc, once for each direction. The smallest radius of curvature of WGS84 is 6335 km (meridian at the
/// equator).
double bulge_m(const GeographicExtent& area, double height_max_m) {
    constexpr double kSmallestRadiusM = 6335000.0;
    const double interval_rad =
        (area.north_deg - area.south_deg) / (kSamples - 1) * 3.14159265358979323846 / 180.0;
    return 2.0 * (kEquatorialRadiusM + height_max_m) * (1.0 - std::cos(interval_rad / 2.0)) *
           (kEquatorialRadiusM / kSmallestRadiusM);
}

}  // namespace

TileBounds tile_bounds(TileId tile, double height_min_m, double height_max_m) {
    const GeographicExtent area = extent(tile);
    const Geodetic middle{(area.south_deg + area.north_deg) / 2.0, (area.west_deg + area.east_deg) / 2.0,
                          EllipsoidalHeight{(height_min_m + height_max_m) / 2.0}};
    TileBounds bounds;
    bounds.axes = east_north_up(middle.latitude_deg, middle.longitude_deg);
    const Ecef origin = to_ecef(middle);
    bounds.direction = glm::normalize(unit_sphere_space(origin));

    glm::dvec3 low{0.0};
    glm::dvec3 high{0.0};
    double least_cosine = 1.0;
    for (const double height_m : {height_min_m, height_max_m}) {
        for (int i = 0; i < kSamples * kSamples; ++i) {
            const Ecef point = to_ecef(sample_place(area, i / kSamples, i % kSamples, height_m));
            const glm::dvec3 local = glm::transpose(bounds.axes) * (point - origin);
            low = glm::min(low, local);
            high = glm::max(high, local);
            const glm::dvec3 scaled = unit_sphere_space(point);
            least_cosine = std::min(least_cosine, glm::dot(glm::normalize(scaled), bounds.direction));
        }
    }
    const double bulge = bulge_m(area, height_max_m);
    bounds.half_m = (high - low) / 2.0 + bulge;
    bounds.centre = origin + bounds.axes * ((low + high) / 2.0);
    // Between two samples the angle from the middle exceeds the larger of theirs by less than a sample
    // interval.
    constexpr double kAngleMargin = 1.1;
    bounds.half_angle_rad = std::acos(std::clamp(least_cosine, -1.0, 1.0)) * kAngleMargin;
    bounds.radius = 1.0 + std::max(height_max_m, 0.0) / kPolarRadiusM;
    return bounds;
}

double distance_m(const TileBounds& bounds, const Ecef& point) {
    const glm::dvec3 local = glm::transpose(bounds.axes) * (point - bounds.centre);
    return glm::length(glm::max(glm::abs(local) - bounds.half_m, glm::dvec3{0.0}));
}

bool outside(const TileBounds& bounds, const Ecef& eye, const glm::dvec3& normal) {
    const glm::dvec3 across = glm::transpose(bounds.axes) * normal;
    return glm::dot(normal, bounds.centre - eye) + glm::dot(glm::abs(across), bounds.half_m) < 0.0;
}

HorizonOccluder::HorizonOccluder(const Ecef& eye, double lowest_height_m) {
    const glm::dvec3 scaled = unit_sphere_space(eye);
    const double distance = glm::length(scaled);
    eye_direction_ = distance > 0.0 ? scaled / distance : glm::dvec3{0.0, 0.0, 1.0};
    occluder_radius_ = 1.0 + std::min(lowest_height_m, 0.0) / kPolarRadiusM;
    eye_horizon_rad_ = distance > occluder_radius_ ? std::acos(occluder_radius_ / distance) : -1.0;
}

bool HorizonOccluder::hides(const TileBounds& bounds) const { return hides(bounds, 0.0, bounds.radius); }

bool HorizonOccluder::hides(const TileBounds& bounds, double beyond_m, double radius) const {
    return hides_cone(bounds.direction, bounds.half_angle_rad + beyond_m / kPolarRadiusM, radius);
}

bool HorizonOccluder::hides(const Ecef& point) const {
    const glm::dvec3 scaled = unit_sphere_space(point);
    const double distance = glm::length(scaled);
    return hides_cone(scaled / distance, 0.0, distance);
}

bool HorizonOccluder::hides(const Ecef& centre, double ball_m, double radius) const {
    const glm::dvec3 scaled = unit_sphere_space(centre);
    const double distance = glm::length(scaled);
    const double sine = ball_m / kPolarRadiusM / distance;
    return sine < 1.0 && hides_cone(scaled / distance, std::asin(sine), radius);
}

bool HorizonOccluder::hides_cone(const glm::dvec3& direction, double half_angle_rad, double radius) const {
    if (eye_horizon_rad_ < 0.0) return false;
    const double to_middle = std::acos(std::clamp(glm::dot(eye_direction_, direction), -1.0, 1.0));
    const double beyond_horizon = std::acos(std::min(occluder_radius_ / radius, 1.0));
    return to_middle - half_angle_rad > eye_horizon_rad_ + beyond_horizon;
}

}  // namespace eyepoint::terrain
