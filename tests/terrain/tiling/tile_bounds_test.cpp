#include "terrain/tiling/tile_bounds.hpp"

#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "terrain/geodesy/earth.hpp"

namespace eyepoint::terrain {
namespace {

double uniform(double low, double high) { return low + (high - low) * *rc::gen::inRange(0, 1000001) * 1e-6; }

TileId any_tile(std::uint32_t deepest) {
    const auto depth = *rc::gen::inRange<std::uint32_t>(0, deepest);
    return {depth, *rc::gen::inRange<std::uint32_t>(0, tiles_across(depth)),
            *rc::gen::inRange<std::uint32_t>(0, tiles_up(depth))};
}

Ecef any_point_of(TileId tile, double low_m, double high_m) {
    const GeographicExtent area = extent(tile);
    return to_ecef({uniform(area.south_deg, area.north_deg), uniform(area.west_deg, area.east_deg),
                    EllipsoidalHeight{uniform(low_m, high_m)}});
}

RC_GTEST_PROP(TileBounds, TheBoxHoldsEveryPointOfTheTile, ()) {
    const TileId tile = any_tile(20);
    const double low_m = uniform(-500.0, 4000.0), high_m = low_m + uniform(0.0, 4000.0);
    const TileBounds bounds = tile_bounds(tile, low_m, high_m);
    RC_ASSERT(distance_m(bounds, any_point_of(tile, low_m, high_m)) <= 1e-6);
}

RC_GTEST_PROP(TileBounds, DistanceIsNeverMoreThanToAnyPointOfTheTile, ()) {
    const TileId tile = any_tile(20);
    const TileBounds bounds = tile_bounds(tile, 0.0, 1000.0);
    const Ecef eye =
        to_ecef({uniform(-90.0, 90.0), uniform(-180.0, 180.0), EllipsoidalHeight{uniform(0.0, 500000.0)}});
    RC_ASSERT(distance_m(bounds, eye) <= glm::distance(eye, any_point_of(tile, 0.0, 1000.0)) + 1e-6);
}

RC_GTEST_PROP(TileBounds, ATileOutsideAPlaneHasNoPointInside, ()) {
    const TileId tile = any_tile(16);
    const TileBounds bounds = tile_bounds(tile, 0.0, 3000.0);
    const Ecef eye =
        to_ecef({uniform(-90.0, 90.0), uniform(-180.0, 180.0), EllipsoidalHeight{uniform(0.0, 500000.0)}});
    const glm::dvec3 normal = glm::normalize(glm::dvec3{uniform(-1, 1), uniform(-1, 1), uniform(-1, 1.001)});
    const glm::dvec3 side = outside(bounds, eye, normal) ? normal : -normal;
    if (!outside(bounds, eye, side)) RC_SUCCEED("the plane cuts the box");
    RC_ASSERT(glm::dot(any_point_of(tile, 0.0, 3000.0) - eye, side) <= 0.0);
}

/// Whether the segment between two points passes through the WGS84 ellipsoid: closed form, in the space where
/// it is a unit sphere.
bool ellipsoid_between(const Ecef& a, const Ecef& b) {
    const glm::dvec3 radii{kEquatorialRadiusM, kEquatorialRadiusM, kPolarRadiusM};
    const glm::dvec3 from = a / radii, step = (b - a) / radii;
    const double aa = glm::dot(step, step), bb = glm::dot(from, step), cc = glm::dot(from, from) - 1.0;
    const double root = bb * bb - aa * cc;
    if (root <= 0.0) return false;
    const double first = (-bb - std::sqrt(root)) / aa;
    return first > 0.0 && first < 1.0;
}

RC_GTEST_PROP(HorizonOccluder, HidesOnlyWhatTheEllipsoidStandsBefore, ()) {
    const TileId tile = any_tile(16);
    const double high_m = uniform(0.0, 9000.0);
    const Ecef eye = to_ecef(
        {uniform(-90.0, 90.0), uniform(-180.0, 180.0), EllipsoidalHeight{std::pow(10.0, uniform(0.0, 6.0))}});
    if (!HorizonOccluder(eye, 0.0).hides(tile_bounds(tile, 0.0, high_m))) RC_SUCCEED("in sight");
    const Ecef point = any_point_of(tile, 1.0, std::max(high_m, 1.0));
    RC_ASSERT(ellipsoid_between(eye, point));
}

TEST(HorizonOccluder, HidesTheFarSideOfTheEarth) {
    const Ecef eye = to_ecef({46.5, 8.0, EllipsoidalHeight{3000.0}});
    const HorizonOccluder horizon(eye, -100.0);
    EXPECT_TRUE(horizon.hides(tile_bounds(tile_at(-46.5, -172.0, 6), 0.0, 4000.0)));
    EXPECT_TRUE(horizon.hides(tile_bounds(tile_at(46.5, 20.0, 9), 0.0, 4000.0)));
    EXPECT_FALSE(horizon.hides(tile_bounds(tile_at(46.5, 10.0, 9), 0.0, 4000.0)));
}

TEST(HorizonOccluder, HidesNothingFromAnEyeBelowIt) {
    const HorizonOccluder horizon(to_ecef({0.0, 0.0, EllipsoidalHeight{-200.0}}), -100.0);
    EXPECT_FALSE(horizon.hides(tile_bounds(tile_at(0.0, 170.0, 8), 0.0, 0.0)));
}

}  // namespace
}  // namespace eyepoint::terrain
