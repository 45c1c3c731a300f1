#include "terrain/surface/surface_height.hpp"

#include <memory>

#include <gtest/gtest.h>

#include "tests/support/analytic_terrain.hpp"

namespace eyepoint::terrain {
namespace {

constexpr double kHeightStepM = 1.0 / 16.0;
constexpr double kLatitudeDeg = 10.0;

/// A planet with detail on both sides of the antimeridian.
class SurfaceHeightTest : public ::testing::Test {
  protected:
    static void SetUpTestSuite() {
        planet_ = std::make_unique<testing::AnalyticPlanet>(testing::AnalyticTerrain{
            .latitude_deg = kLatitudeDeg, .longitude_deg = 180.0, .detail_depth = 8});
    }
    static void TearDownTestSuite() { planet_.reset(); }

    /// Of full detail.
    static TileId tile() { return tile_at(kLatitudeDeg + 0.01, 179.96, planet_->terrain().detail_depth); }
    static double truth_m(double latitude_deg, double longitude_deg) {
        return testing::analytic_height_m(planet_->terrain(), latitude_deg, longitude_deg);
    }

    static inline std::unique_ptr<testing::AnalyticPlanet> planet_;
    SurfaceHeight surface_{planet_->database()};
};

TEST_F(SurfaceHeightTest, AtAPostIsTheSourcesHeightToTheStoredStep) {
    for (const int row : {0, 7, 16, 31}) {
        const double latitude = post_latitude_deg(tile(), row), longitude = post_longitude_deg(tile(), 9);
        const auto height = surface_.at(latitude, longitude);
        ASSERT_TRUE(height);
        EXPECT_NEAR(height->metres(), truth_m(latitude, longitude), kHeightStepM);
    }
}

TEST_F(SurfaceHeightTest, BetweenPostsIsOnTheTriangle) {
    const double step = post_spacing_deg(tile().depth);
    const double south = post_latitude_deg(tile(), 4), west = post_longitude_deg(tile(), 5);
    const auto corner = [&](double up, double right) {
        return truth_m(south + up * step, west + right * step);
    };
    // The middle of the diagonal from south-west to north-east, and a point in each triangle.
    EXPECT_NEAR(surface_.at(south + 0.5 * step, west + 0.5 * step)->metres(),
                (corner(0, 0) + corner(1, 1)) / 2, kHeightStepM);
    EXPECT_NEAR(surface_.at(south + 0.25 * step, west + 0.75 * step)->metres(),
                0.25 * corner(0, 0) + 0.5 * corner(0, 1) + 0.25 * corner(1, 1), kHeightStepM);
    EXPECT_NEAR(surface_.at(south + 0.75 * step, west + 0.25 * step)->metres(),
                0.25 * corner(0, 0) + 0.5 * corner(1, 0) + 0.25 * corner(1, 1), kHeightStepM);
}

TEST_F(SurfaceHeightTest, IsTheSameOnBothSidesOfTheAntimeridianAndAtThePoles) {
    EXPECT_DOUBLE_EQ(surface_.at(10.0, 180.0)->metres(), surface_.at(10.0, -180.0)->metres());
    EXPECT_NEAR(surface_.at(10.0, 180.0 - 1e-9)->metres(), surface_.at(10.0, -180.0 + 1e-9)->metres(), 1e-3);
    EXPECT_DOUBLE_EQ(surface_.at(90.0, 12.0)->metres(), surface_.at(90.0, -150.0)->metres());
    EXPECT_TRUE(surface_.at(-90.0, 0.0));
}

}  // namespace
}  // namespace eyepoint::terrain
