#include "tests/terrain/lod/places.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "terrain/geodesy/earth.hpp"
#include "tests/terrain/lod/look.hpp"

namespace eyepoint::testing {

using terrain::Ecef;
using terrain::EllipsoidalHeight;
using terrain::LodView;

namespace {

const AnalyticPlanet& equator() {
    static const AnalyticPlanet planet{
        {.latitude_deg = 0.0, .longitude_deg = 0.0, .half_size_deg = 0.3, .detail_depth = 9}};
    return planet;
}

const AnalyticPlanet& antimeridian() {
    static const AnalyticPlanet planet{
        {.latitude_deg = -16.8, .longitude_deg = 180.0, .half_size_deg = 0.3, .detail_depth = 9}};
    return planet;
}

const AnalyticPlanet& pole() {
    static const AnalyticPlanet planet{{.latitude_deg = 89.7, .longitude_deg = 30.0, .detail_depth = 8}};
    return planet;
}

constexpr std::array<Place, 4> kPlaces{
    {{"alps", hills}, {"equator", equator}, {"antimeridian", antimeridian}, {"pole", pole}}};

/// A course and an angle up, as a direction over a place.
glm::dvec3 towards(const glm::dmat3& enu, double course_rad, double up_rad) {
    return enu * glm::dvec3{std::sin(course_rad) * std::cos(up_rad), std::cos(course_rad) * std::cos(up_rad),
                            std::sin(up_rad)};
}

}  // namespace

const AnalyticPlanet& hills() {
    static const AnalyticPlanet planet{kHills};
    return planet;
}

const AnalyticPlanet& sea() {
    static const AnalyticPlanet planet{{.detail_depth = 2, .amplitude_m = 0.0}};
    return planet;
}

std::span<const Place> places() { return kPlaces; }

LodView random_view(const AnalyticTerrain& terrain, std::mt19937_64& random) {
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    const auto around = [&](double middle_deg) {
        return middle_deg + (unit(random) * 2.0 - 1.0) * 1.2 * terrain.half_size_deg;
    };
    const double latitude_deg = std::min(90.0, around(terrain.latitude_deg)),
                 longitude_deg = around(terrain.longitude_deg);
    // Over a pole itself an eye among the hills is in the boxes of all tiles that meet there, 2^(d+1) at
    // depth d: thousands of blocks at full resolution. Above the highest hill a few hundred show the same
    // seams.
    const double above_m =
        std::max(std::pow(10.0, 0.3 + 5.5 * unit(random)), latitude_deg == 90.0 ? 2000.0 : 0.0);
    const double ground_m = analytic_height_m(terrain, latitude_deg, longitude_deg);
    const Ecef eye = terrain::to_ecef({latitude_deg, longitude_deg, EllipsoidalHeight{ground_m + above_m}});
    const glm::dmat3 enu = terrain::east_north_up(latitude_deg, longitude_deg);
    const double course_rad = unit(random) * 6.283, up_rad = -1.5 * unit(random) * unit(random);
    return look(eye, towards(enu, course_rad, up_rad), enu * glm::dvec3{0.1, 0.05, 1.0},
                0.5 + 4.0 * unit(random));
}

LodView look_from(double height_m, double course_deg, double down_deg, double tau_px) {
    const glm::dmat3 enu = terrain::east_north_up(kHills.latitude_deg, kHills.longitude_deg);
    constexpr double kRadians = 3.14159265358979 / 180.0;
    const Ecef eye =
        terrain::to_ecef({kHills.latitude_deg, kHills.longitude_deg, EllipsoidalHeight{height_m}});
    return look(eye, towards(enu, course_deg * kRadians, -down_deg * kRadians),
                enu * glm::dvec3{0.1, 0.05, 1.0}, tau_px);
}

LodView along(double metres, double tau_px, double slack_px) {
    const glm::dmat3 enu = terrain::east_north_up(kHills.latitude_deg, kHills.longitude_deg);
    const Ecef eye =
        terrain::to_ecef({kHills.latitude_deg, kHills.longitude_deg, EllipsoidalHeight{2500.0}}) +
        enu * glm::dvec3{0.7 * metres, 0.7 * metres, 0.0};
    return look(eye, enu * glm::dvec3{0.7, 0.7, -0.2}, enu * glm::dvec3{0.1, 0.05, 1.0}, tau_px, slack_px);
}

}  // namespace eyepoint::testing
