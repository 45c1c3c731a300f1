#include <cmath>

#include <gtest/gtest.h>

#include "terrain/geodesy/earth.hpp"
#include "tests/tools/bench/small_flight.hpp"
#include "tools/bench/measure/mesh_faults.hpp"

namespace eyepoint::tools {
namespace {

using testing::kSmallHills;
using testing::look_north;
using testing::SmallFlight;

/// Given a mesh so fine that every post is a vertex; then every post is covered once and off by rounding
/// alone.
void expect_exact(const testing::AnalyticTerrain& terrain, const terrain::LodView& view) {
    const testing::AnalyticPlanet place(terrain);
    SmallFlight flight(place.database());
    const DrawnMesh mesh = flight.mesh(view);
    const PostFigures figures = flight.figures(mesh, view);
    EXPECT_GT(figures.error.count(), 1000U);
    EXPECT_EQ(figures.uncovered, 0U);
    EXPECT_EQ(figures.overlapped, 0U);
    EXPECT_EQ(figures.folded, 0U);
    EXPECT_LT(figures.error.maximum(), 1e-3);
    EXPECT_TRUE(find_mesh_faults(mesh).whole());
}

constexpr double kFinestTauPx = 0.004;

TEST(PostError, IsRoundingAloneWhereEveryPostIsAVertex) {
    expect_exact(kSmallHills, look_north(46.4, 8.25, 6000.0, 30.0, kFinestTauPx));
}

TEST(PostError, IsRoundingAloneAcrossTheAntimeridian) {
    auto terrain = kSmallHills;
    terrain.latitude_deg = 0.1;
    terrain.longitude_deg = 180.0;
    expect_exact(terrain, look_north(0.0, 180.0, 6000.0, 30.0, kFinestTauPx));
}

TEST(PostError, IsRoundingAloneOverThePole) {
    auto terrain = kSmallHills;
    terrain.latitude_deg = 90.0;
    terrain.detail_depth = 9;
    expect_exact(terrain, look_north(89.9, 20.0, 8000.0, 60.0, kFinestTauPx));
}

/// The chord between two vertices on a meridian of a bare ellipsoid lies under the post between them by what
/// GeographicLib says of its middle.
TEST(PostError, OfAChordIsItsSagitta) {
    const testing::AnalyticTerrain sea{.half_size_deg = 0.2, .detail_depth = 10, .amplitude_m = 0.0};
    const testing::AnalyticPlanet place_of_sea(sea);
    SmallFlight flight(place_of_sea.database());
    const auto view = look_north(46.4, 8.25, 5000.0, 45.0, 40.0);  // so coarse that posts are left out
    const MeasuredPosts posts = flight.measure(flight.mesh(view), view);
    std::size_t compared = 0;
    for (const MeasuredTile& tile : posts.tiles) {
        if (tile.tile->tile.depth != sea.detail_depth) continue;
        for (int step = 2; step <= 8; step *= 2) {
            // Corner (0, 0) and the next one of a mesh of every step-th post; a row between is on their
            // chord, if that is the mesh drawn.
            const auto middle = static_cast<std::size_t>(step / 2 * PostTile::kSide);
            const auto place = [&](int row) {
                return terrain::to_ecef({post_latitude_deg(tile.tile->tile, row),
                                         post_longitude_deg(tile.tile->tile, 0),
                                         terrain::EllipsoidalHeight{0.0}});
            };
            const double sagitta_m = terrain::to_geodetic((place(0) + place(step)) / 2.0).height.metres();
            const double above_m = tile.above_m[middle];
            if (std::abs(above_m) < 1e-3 || std::abs(above_m - sagitta_m) > std::abs(sagitta_m) * 0.2)
                continue;
            EXPECT_NEAR(above_m, sagitta_m, 2e-3) << "step " << step;
            ++compared;
        }
    }
    EXPECT_GT(compared, 0U);
}

}  // namespace
}  // namespace eyepoint::tools
