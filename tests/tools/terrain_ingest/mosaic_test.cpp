// Several grids as one surface.
#include "tools/terrain/mosaic.hpp"

#include <cmath>
#include <random>

#include <GeographicLib/Geoid.hpp>
#include <gtest/gtest.h>

#include "tests/tools/terrain_ingest/mosaic_height.hpp"
#include "tests/tools/terrain_ingest/raster_files.hpp"
#include "tools/terrain/vertical_datum.hpp"

namespace eyepoint::tools {
namespace {

using testing::grid_of;

/// Rough ground above the sea, a function of the post alone.
double rough(int column, int row) {
    const std::uint32_t mixed =
        static_cast<std::uint32_t>(column) * 73856093U ^ static_cast<std::uint32_t>(row) * 19349663U;
    return 200.0 + static_cast<double>((mixed * 2654435761U) >> 24);
}

HeightGrid planet(double height_m) {
    return grid_of(36, 18, -175.0, 85.0, 10.0, [=](int, int) { return height_m; });
}

TEST(Mosaic, GivesEveryPostItsValueExactly) {
    // Posts on whole 3 arc-seconds, as SRTM has them, whose spacing is no binary fraction.
    std::vector<HeightGrid> grids;
    grids.push_back(grid_of(121, 121, 8.0, 47.0, 3.0 / 3600.0, rough));
    const Mosaic mosaic{std::move(grids), testing::geoid(), {}};
    for (int row = 10; row < 111; ++row) {
        for (int column = 10; column < 111; ++column) {
            ASSERT_EQ(msl_at(mosaic, 47.0 - row * 3.0 / 3600.0, 8.0 + column * 3.0 / 3600.0),
                      static_cast<float>(rough(column, row)))
                << column << ' ' << row;
        }
    }
}

TEST(Mosaic, BetweenPostsNeverLeavesTheirRange) {
    std::vector<HeightGrid> grids;
    grids.push_back(grid_of(60, 60, 8.0, 47.0, 0.01, rough));
    const Mosaic mosaic{std::move(grids), testing::geoid(), {}};
    std::mt19937 random{1};
    std::uniform_real_distribution<double> within{10.0, 48.0};
    for (int i = 0; i < 20'000; ++i) {
        const double column = within(random);
        const double row = within(random);
        double low = 1e9;
        double high = -1e9;
        for (int corner = 0; corner < 4; ++corner) {
            const double height =
                rough(static_cast<int>(column) + (corner & 1), static_cast<int>(row) + (corner >> 1));
            low = std::min(low, height);
            high = std::max(high, height);
        }
        const float height = msl_at(mosaic, 47.0 - row * 0.01, 8.0 + column * 0.01);
        EXPECT_GE(height, low - 1e-3);
        EXPECT_LE(height, high + 1e-3);
    }
}

TEST(Mosaic, NeighboursOnOneLatticeAreAsOneGrid) {
    // The same ground as one grid, and as four that share their edge posts as SRTM tiles do.
    std::vector<HeightGrid> one;
    one.push_back(grid_of(81, 81, 8.0, 47.0, 0.01, rough));
    std::vector<HeightGrid> four;
    for (int tile = 0; tile < 4; ++tile) {
        const int column0 = tile % 2 * 40;
        const int row0 = tile / 2 * 40;
        four.push_back(grid_of(41, 41, 8.0 + column0 * 0.01, 47.0 - row0 * 0.01, 0.01,
                               [&](int column, int row) { return rough(column0 + column, row0 + row); }));
        four.back().order = static_cast<std::size_t>(tile);
    }
    const auto joined = join_neighbours(four);
    ASSERT_EQ(joined.size(), 1U);
    EXPECT_EQ(joined.front().heights_m, one.front().heights_m);
    EXPECT_EQ(joined.front().files.size(), 4U);
}

TEST(Mosaic, TheSameForTheSamePlaceWhoeverAsks) {
    std::vector<HeightGrid> grids;
    grids.push_back(grid_of(41, 41, 8.0, 47.0, 0.01, rough));
    grids.push_back(planet(30.0));
    const Mosaic mosaic{std::move(grids), testing::geoid(), {}};
    // The same 33 posts as the east edge of a tile and the west edge of its neighbour.
    const terrain::TileId west = terrain::tile_at(46.8, 8.2, 11);
    const terrain::TileId east = *neighbour(west, terrain::Edge::East);
    const double step = terrain::post_spacing_deg(11);
    const auto edge = [&](terrain::TileId tile, int column) {
        const auto sides = extent(tile);
        std::vector<SurfaceSample> samples(33 * 33);
        mosaic.sample({sides.south_deg, sides.west_deg, step, 33, 33}, samples);
        std::vector<float> heights;
        for (int row = 0; row < 33; ++row) {
            heights.push_back(samples[static_cast<std::size_t>(row * 33 + column)].ellipsoidal_height_m);
        }
        return heights;
    };
    EXPECT_EQ(edge(west, 32), edge(east, 0));
}

TEST(Mosaic, FadesIntoCoarserDataWithoutAStep) {
    std::vector<HeightGrid> grids;
    grids.push_back(grid_of(201, 201, 8.0, 47.0, 0.001, [](int, int) { return 1000.0; }));
    grids.push_back(planet(400.0));
    const Mosaic mosaic{std::move(grids), testing::geoid(), {}};
    EXPECT_EQ(mosaic.facts().front().margin_posts, 10);
    EXPECT_EQ(msl_at(mosaic, 46.9, 8.1), 1000.0F) << "inside";
    EXPECT_EQ(msl_at(mosaic, 46.9, 8.0), 400.0F) << "on the outermost post";
    EXPECT_EQ(msl_at(mosaic, 46.9, 7.9), 400.0F) << "outside";
    float before = 400.0F;
    for (double longitude = 7.99; longitude < 8.02; longitude += 0.0001) {
        const float here = msl_at(mosaic, 46.9, longitude);
        // A smoothstep of 600 m over 10 posts is steepest at 1.5 times the mean: 9 m a tenth of a post.
        EXPECT_LT(std::abs(here - before), 10.0F) << longitude;
        before = here;
    }
}

TEST(Mosaic, DoesNotFadeWhereAnotherOfItsKindContinues) {
    // Half a post off the first's lattice, so they are not joined.
    std::vector<HeightGrid> grids;
    grids.push_back(grid_of(101, 101, 8.0, 47.0, 0.001, [](int, int) { return 1000.0; }));
    grids.push_back(grid_of(101, 101, 8.0905, 47.0, 0.001, [](int, int) { return 1000.0; }));
    grids[1].order = 1;
    grids.push_back(planet(0.5));
    grids[2].order = 2;
    auto joined = join_neighbours(std::move(grids));
    ASSERT_EQ(joined.size(), 3U);
    const Mosaic mosaic{std::move(joined), testing::geoid(), {}};
    for (double longitude = 8.03; longitude < 8.16; longitude += 0.0007) {
        EXPECT_NEAR(msl_at(mosaic, 46.95, longitude), 1000.0F, 0.05F) << longitude;
    }
}

TEST(Mosaic, FinestFirstThenTheOrderGiven) {
    std::vector<HeightGrid> grids;
    grids.push_back(grid_of(101, 101, 8.0, 47.0, 0.004, [](int, int) { return 100.0; }));
    grids.push_back(grid_of(101, 101, 8.1, 46.9, 0.001, [](int, int) { return 200.0; }));
    grids.push_back(grid_of(101, 101, 8.1005, 46.9, 0.001, [](int, int) { return 300.0; }));
    for (std::size_t i = 0; i < grids.size(); ++i) grids[i].order = i;
    const Mosaic mosaic{std::move(grids), testing::geoid(), {}};
    EXPECT_EQ(msl_at(mosaic, 46.85, 8.15), 200.0F);
    EXPECT_EQ(msl_at(mosaic, 46.70, 8.10), 100.0F);
}

TEST(Mosaic, TheAntimeridianIsNoEdge) {
    // A grid that crosses 180 degrees, and one on each side that meet there.
    std::vector<HeightGrid> crossing;
    crossing.push_back(grid_of(101, 41, 179.5, 10.0, 0.01, rough));
    const Mosaic one{std::move(crossing), testing::geoid(), {}};
    EXPECT_EQ(msl_at(one, 9.8, 180.0), static_cast<float>(rough(50, 20)));
    EXPECT_EQ(msl_at(one, 9.8, -180.0), static_cast<float>(rough(50, 20)));
    EXPECT_EQ(msl_at(one, 9.8, -179.9), static_cast<float>(rough(60, 20)));
    EXPECT_TRUE(one.has_detail(terrain::tile_at(9.8, -179.8, 7)));
    EXPECT_TRUE(one.has_detail(terrain::tile_at(9.8, 179.8, 7)));
    EXPECT_FALSE(one.has_detail(terrain::tile_at(9.8, 170.0, 7)));

    std::vector<HeightGrid> world;
    world.push_back(grid_of(360, 180, -179.5, 89.5, 1.0, [](int column, int) { return 100.0 + column; }));
    const Mosaic around{std::move(world), testing::geoid(), {}};
    // Half way between the last column (459 m) and the first (100 m); Steffen's cubic is symmetric there.
    EXPECT_NEAR(msl_at(around, 0.0, 180.0), 279.5F, 1.0F);
    EXPECT_EQ(msl_at(around, 0.0, 180.0), msl_at(around, 0.0, -180.0));
}

TEST(Mosaic, APoleIsOnePlace) {
    std::vector<HeightGrid> world;
    world.push_back(grid_of(36, 18, -175.0, 85.0, 10.0, [](int column, int) { return 100.0 + column; }));
    const Mosaic mosaic{std::move(world), testing::geoid(), {}};
    const float pole = msl_at(mosaic, 90.0, 0.0);
    for (const double longitude : {-180.0, -33.0, 90.0, 179.0})
        EXPECT_EQ(msl_at(mosaic, 90.0, longitude), pole);
    EXPECT_EQ(msl_at(mosaic, 95.0, 20.0), msl_at(mosaic, 85.0, -160.0)) << "past the pole is the other side";
    EXPECT_TRUE(mosaic.is_global());
}

TEST(Mosaic, AddsTheGeoidOnceAndExactly) {
    const GeographicLib::Geoid egm96{"egm96-15", terrain::Geoid::default_grid().parent_path().string()};
    std::vector<HeightGrid> grids;
    grids.push_back(planet(750.0));
    const Mosaic mosaic{std::move(grids), testing::geoid(), {}};
    std::vector<SurfaceSample> samples(25);
    mosaic.sample({46.0, 7.0, 0.37, 5, 5}, samples);
    for (int i = 0; i < 25; ++i) {
        EXPECT_NEAR(samples[static_cast<std::size_t>(i)].ellipsoidal_height_m,
                    750.0 + egm96(46.0 + 0.37 * (i / 5), 7.0 + 0.37 * (i % 5)), 1e-3);
    }
}

TEST(Mosaic, EllipsoidalFilesComeBackAsTheyWere) {
    HeightGrid grid = grid_of(61, 61, 8.0, 47.0, 0.001, rough);
    std::vector<HeightGrid> grids;
    grids.push_back(to_msl(grid, testing::geoid()));
    const Mosaic mosaic{std::move(grids), testing::geoid(), {}};
    std::vector<SurfaceSample> samples(1);
    for (int i = 10; i < 50; ++i) {
        mosaic.sample({47.0 - i * 0.001, 8.0 + i * 0.001, 1.0, 1, 1}, samples);
        EXPECT_NEAR(samples[0].ellipsoidal_height_m, rough(i, i), 1e-3);
    }
}

TEST(Mosaic, TheSeaIsFlatAndCoarserLandFadesItOut) {
    std::vector<HeightGrid> grids;
    grids.push_back(
        grid_of(61, 61, 8.0, 47.0, 0.001, [](int column, int) { return column < 30 ? 0.0 : 50.0; }));
    const Mosaic mosaic{std::move(grids), testing::geoid(), {}};
    const std::vector<LatLon> places{{46.97, 8.0105}, {46.97, 8.0295}, {46.97, 8.0405}, {0.0, 0.0}};
    const auto samples = mosaic.sample_msl(places);
    EXPECT_TRUE(samples[0].water);
    EXPECT_EQ(samples[0].msl_height_m, 0.0F);
    EXPECT_FALSE(samples[1].water) << "the shore's slope";
    EXPECT_GT(samples[1].msl_height_m, 0.0F);
    EXPECT_FALSE(samples[2].water);
    EXPECT_TRUE(samples[3].water) << "where there is no data the planet is sea";
    EXPECT_FALSE(mosaic.is_global());
}

TEST(Mosaic, IsAsDeepAsItsSourcesAreFine) {
    std::vector<HeightGrid> grids;
    grids.push_back(grid_of(121, 121, 8.0, 47.0, 3.0 / 3600.0, rough));
    grids.push_back(planet(30.0));
    const Mosaic mosaic{std::move(grids), testing::geoid(), {}};
    // 3 arc-seconds lie between the posts of depth 12 (4.9") and 13 (2.47").
    EXPECT_TRUE(mosaic.has_detail(terrain::tile_at(46.95, 8.05, 13)));
    EXPECT_FALSE(mosaic.has_detail(terrain::tile_at(46.95, 8.05, 14)));
    EXPECT_FALSE(mosaic.has_detail(terrain::tile_at(40.0, 8.05, 6)));
}

TEST(Mosaic, OpenSeaIsNotMadeDeep) {
    std::vector<HeightGrid> grids;
    grids.push_back(grid_of(1201, 1201, -29.0, 39.0, 3.0 / 3600.0,
                            [](int column, int row) { return column > 1100 && row > 1100 ? 40.0 : 0.0; }));
    const Mosaic mosaic{std::move(grids), testing::geoid(), {}};
    EXPECT_TRUE(mosaic.has_detail(terrain::tile_at(38.05, -28.05, 13)));
    EXPECT_FALSE(mosaic.has_detail(terrain::tile_at(38.8, -28.8, kDeepestSeaTile + 1)));
}

}  // namespace
}  // namespace eyepoint::tools
