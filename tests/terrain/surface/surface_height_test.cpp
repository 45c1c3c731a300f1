#include "terrain/surface/surface_height.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/analytic_terrain.hpp"

namespace eyepoint::terrain {
namespace {

constexpr double kHeightStepM = 1.0 / 16.0;

TEST(SurfaceHeight, AtAPostIsTheSourcesHeightToTheStoredStep) {
    const testing::AnalyticTerrain terrain;
    const testing::ScratchFolder scratch;
    SurfaceHeight surface(testing::make_database(terrain, scratch.path() / "db"));
    for (const int row : {0, 7, 16, 31}) {
        const TileId tile = tile_at(46.51, 8.21, terrain.detail_depth);
        const double latitude = post_latitude_deg(tile, row), longitude = post_longitude_deg(tile, 9);
        const auto height = surface.at(latitude, longitude);
        ASSERT_TRUE(height);
        EXPECT_NEAR(height->metres(), testing::analytic_height_m(terrain, latitude, longitude), kHeightStepM);
    }
}

TEST(SurfaceHeight, BetweenPostsIsOnTheTriangle) {
    const testing::AnalyticTerrain terrain;
    const testing::ScratchFolder scratch;
    SurfaceHeight surface(testing::make_database(terrain, scratch.path() / "db"));
    const TileId tile = tile_at(46.51, 8.21, terrain.detail_depth);
    const double step = post_spacing_deg(tile.depth);
    const double south = post_latitude_deg(tile, 4), west = post_longitude_deg(tile, 5);
    const auto corner = [&](double up, double right) {
        return testing::analytic_height_m(terrain, south + up * step, west + right * step);
    };
    // The middle of the diagonal from south-west to north-east, and a point in each triangle.
    EXPECT_NEAR(surface.at(south + 0.5 * step, west + 0.5 * step)->metres(),
                (corner(0, 0) + corner(1, 1)) / 2, kHeightStepM);
    EXPECT_NEAR(surface.at(south + 0.25 * step, west + 0.75 * step)->metres(),
                0.25 * corner(0, 0) + 0.5 * corner(0, 1) + 0.25 * corner(1, 1), kHeightStepM);
    EXPECT_NEAR(surface.at(south + 0.75 * step, west + 0.25 * step)->metres(),
                0.25 * corner(0, 0) + 0.5 * corner(1, 0) + 0.25 * corner(1, 1), kHeightStepM);
}

TEST(SurfaceHeight, IsTheSameOnBothSidesOfTheAntimeridianAndAtThePoles) {
    const testing::AnalyticTerrain terrain{.latitude_deg = 10.0, .longitude_deg = 180.0};
    const testing::ScratchFolder scratch;
    SurfaceHeight surface(testing::make_database(terrain, scratch.path() / "db"));
    EXPECT_DOUBLE_EQ(surface.at(10.0, 180.0)->metres(), surface.at(10.0, -180.0)->metres());
    EXPECT_NEAR(surface.at(10.0, 180.0 - 1e-9)->metres(), surface.at(10.0, -180.0 + 1e-9)->metres(), 1e-3);
    EXPECT_DOUBLE_EQ(surface.at(90.0, 12.0)->metres(), surface.at(90.0, -150.0)->metres());
    EXPECT_TRUE(surface.at(-90.0, 0.0));
}

}  // namespace
}  // namespace eyepoint::terrain
