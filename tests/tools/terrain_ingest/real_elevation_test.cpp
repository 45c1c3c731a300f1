// Real files; skipped where EYEPOINT_REAL_DATA is not set.
#include <cmath>

#include <gtest/gtest.h>

#include "tests/tools/terrain_ingest/mosaic_height.hpp"
#include "tests/tools/terrain_ingest/raster_files.hpp"
#include "tools/terrain/gdal_elevation.hpp"
#include "tools/terrain/mosaic.hpp"

namespace eyepoint::tools {
namespace {

#define REQUIRE_REAL_DATA(variable, below)           \
    const auto variable = testing::real_data(below); \
    if (!variable) GTEST_SKIP() << "EYEPOINT_REAL_DATA is not set"

HeightGrid read(const std::string& file) {
    ElevationInput input;
    input.file = file;
    auto grid = read_elevation(input);
    if (!grid) throw std::runtime_error(grid.error());
    return std::move(*grid);
}

TEST(RealElevation, AzoresTilesJoinWithoutASeam) {
    REQUIRE_REAL_DATA(folder, "elevation/azores/");
    std::vector<HeightGrid> tiles;
    for (const char* name : {"N38W029", "N38W028", "N39W029", "N39W028"}) {
        tiles.push_back(read(*folder + name + ".SRTMGL3.hgt.zip"));
        tiles.back().order = tiles.size();
    }
    const HeightGrid west = tiles[0];
    const HeightGrid east = tiles[1];
    auto joined = join_neighbours(std::move(tiles));
    ASSERT_EQ(joined.size(), 1U);
    EXPECT_EQ(joined.front().columns, 2401);
    EXPECT_EQ(joined.front().rows, 2401);
    const Mosaic mosaic{std::move(joined), testing::geoid(), {.sea = SeaRule::None}};
    // The edge at 28 W, 38..39 N crosses Sao Jorge: both files' posts there, exactly, and no step beside it.
    float highest = 0.0F;
    for (int row = 100; row < 1100; ++row) {
        const double latitude = 39.0 - row * 3.0 / 3600.0;
        const float height = msl_at(mosaic, latitude, -28.0);
        EXPECT_EQ(height, west.heights_m[west.index(1200, row)]);
        EXPECT_EQ(height, east.heights_m[east.index(0, row)]);
        EXPECT_NEAR(msl_at(mosaic, latitude, -28.0 - 1e-7), msl_at(mosaic, latitude, -28.0 + 1e-7), 0.1);
        highest = std::max(highest, height);
    }
    EXPECT_EQ(highest, 529.0F);
}

TEST(RealElevation, SrtmPostsAreExactAndVoidsAreFilledWithMountains) {
    REQUIRE_REAL_DATA(file, "elevation/alps/N46E008.tif");
    std::vector<HeightGrid> grids;
    grids.push_back(read(*file));
    EXPECT_EQ(grids.front().files.front().voids, 103'743U);
    const HeightGrid raw = grids.front();
    const Mosaic mosaic{std::move(grids), testing::geoid(), {}};
    EXPECT_EQ(mosaic.facts().front().voids_filled, 103'743U);
    for (int row = 100; row < 1100; row += 7) {
        for (int column = 100; column < 1100; column += 7) {
            const float post = raw.heights_m[raw.index(column, row)];
            const float height = msl_at(mosaic, 47.0 - row * 3.0 / 3600.0, 8.0 + column * 3.0 / 3600.0);
            if (is_void(post)) {
                EXPECT_GT(height, 150.0F);
                EXPECT_LT(height, 4600.0F);
            } else {
                EXPECT_EQ(height, post);
            }
        }
    }
}

TEST(RealElevation, FloatAndIntegerFilesAgree) {
    REQUIRE_REAL_DATA(folder, "elevation/formats/");
    const HeightGrid floats = read(*folder + "elevation-f32.tif");
    const HeightGrid integers = read(*folder + "elevation-i16.tif");
    ASSERT_EQ(floats.heights_m.size(), integers.heights_m.size());
    EXPECT_EQ(floats.files.front().voids, 18'458U);
    EXPECT_EQ(integers.files.front().voids, 18'458U);
    for (std::size_t i = 0; i < floats.heights_m.size(); ++i) {
        ASSERT_EQ(is_void(floats.heights_m[i]), is_void(integers.heights_m[i]));
        if (is_void(floats.heights_m[i])) continue;
        EXPECT_NEAR(floats.heights_m[i], integers.heights_m[i], 0.5);
    }
}

TEST(RealElevation, DanakilStaysDryLandBelowTheSea) {
    REQUIRE_REAL_DATA(file, "elevation/formats/elevation-f32.tif");
    std::vector<HeightGrid> grids;
    grids.push_back(read(*file));
    const Mosaic mosaic{std::move(grids), testing::geoid(), {}};
    // Lake Karum and Dallol, about 120 m below the sea.
    const LatLon place{14.2, 40.35};
    const auto sample = mosaic.sample_msl(std::span{&place, 1}).front();
    EXPECT_LT(sample.msl_height_m, -60.0F);
    EXPECT_FALSE(sample.water);
}

TEST(RealElevation, DtedPostsLieOnTheirArcSeconds) {
    REQUIRE_REAL_DATA(file, "elevation/formats/n43.dt0");
    const HeightGrid grid = read(*file);
    EXPECT_EQ(grid.columns, 121);
    const GridPosition corner = grid.mapping.to_grid(LatLon{44.0, -80.0});
    EXPECT_EQ(corner.column, 0.0);
    EXPECT_EQ(corner.row, 0.0);
}

TEST(RealElevation, FujiStandsWhereItDoes) {
    REQUIRE_REAL_DATA(file, "elevation/formats/fuji.png");
    ElevationInput input;
    input.file = *file;
    input.encoding = HeightEncoding::TerrainRgb;
    input.placement = MercatorTile{10, 906, 404};
    const auto grid = read_elevation(input);
    ASSERT_TRUE(grid) << grid.error();
    const auto top = std::max_element(grid->heights_m.begin(), grid->heights_m.end());
    const auto post = static_cast<int>(top - grid->heights_m.begin());
    const LatLon summit =
        grid->mapping.to_place({static_cast<double>(post % 512), static_cast<double>(post / 512)});
    EXPECT_NEAR(*top, 3751.0F, 0.5F);
    // Kengamine, 35.3606 N 138.7274 E; pixels are 0.0007 degrees wide.
    EXPECT_NEAR(summit.latitude_deg, 35.3606, 0.0015);
    EXPECT_NEAR(summit.longitude_deg, 138.7274, 0.0015);
}

TEST(RealElevation, ACogReadsAsThePlainFile) {
    REQUIRE_REAL_DATA(folder, "elevation/");
    const HeightGrid plain = read(*folder + "alps/N46E008.tif");
    const HeightGrid cog = read(*folder + "formats/N46E008_cog.tif");
    ASSERT_EQ(plain.heights_m.size(), cog.heights_m.size());
    for (std::size_t i = 0; i < plain.heights_m.size(); ++i) {
        if (is_void(plain.heights_m[i])) continue;
        ASSERT_EQ(plain.heights_m[i], cog.heights_m[i]);
    }
}

}  // namespace
}  // namespace eyepoint::tools
