// The whole command, from files to a database.
#include "tools/terrain/build_command.hpp"

#include <filesystem>
#include <numeric>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "terrain/database/database.hpp"
#include "tests/tools/terrain_ingest/raster_files.hpp"

namespace eyepoint::tools {
namespace {

using ::testing::HasSubstr;
using testing::Pixel;
using testing::RasterFile;
using testing::TemporaryFolder;

struct Outcome {
    int exit_code = 0;
    std::string out;
    std::string error;
};

Outcome build(std::vector<std::string> arguments) {
    CLI::App application;
    add_build_command(application);
    arguments.insert(arguments.begin(), "build");
    std::reverse(arguments.begin(), arguments.end());
    Outcome outcome;
    ::testing::internal::CaptureStdout();
    ::testing::internal::CaptureStderr();
    try {
        application.parse(arguments);
    } catch (const CLI::Error& failure) {
        outcome.exit_code = failure.get_exit_code();
    }
    outcome.out = ::testing::internal::GetCapturedStdout();
    outcome.error = ::testing::internal::GetCapturedStderr();
    return outcome;
}

std::string small_dem(const TemporaryFolder& folder) {
    RasterFile file{.columns = 41,
                    .rows = 41,
                    .bands = 1,
                    .pixel = Pixel::Int16,
                    .geotransform = testing::posts_from(8.0, 47.0, 0.01),
                    .epsg = 4326,
                    .nodata = -32768.0,
                    .driver = "GTiff"};
    testing::write_raster(folder.path("dem.tif"), file, [](int, int column, int row) {
        return column == 20 && row == 20 ? -32768.0 : 300.0 + 5.0 * column;
    });
    return folder.path("dem.tif");
}

TEST(BuildCommand, MakesADatabaseThatHoldsTheHeights) {
    const TemporaryFolder folder;
    const Outcome outcome = build({"--dem", small_dem(folder), "-o", folder.path("db"), "--json"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
    const auto report = nlohmann::json::parse(outcome.out);
    EXPECT_EQ(report["voids_filled"], 1);
    EXPECT_EQ(report["elevation"][0]["files"][0]["voids"], 1);
    EXPECT_THAT(report["notes"][0], HasSubstr("sea at MSL 0"));
    const auto database = terrain::Database::open(folder.path("db"));
    ASSERT_TRUE(database) << database.error();
    // 0.01 degrees lie between the posts of depth 9 (0.011) and 10 (0.0055).
    EXPECT_EQ(database->manifest().max_depth, 10U);
    const terrain::TileId tile = terrain::tile_at(46.8, 8.2, 10);
    const auto block = database->read_block(tile);
    ASSERT_TRUE(block) << block.error();
    const double latitude = terrain::post_latitude_deg(tile, 16);
    const double longitude = terrain::post_longitude_deg(tile, 16);
    EXPECT_NEAR(block->height_m(16, 16),
                300.0 + 500.0 * (longitude - 8.0) + testing::geoid().undulation_m(latitude, longitude), 0.1);
}

TEST(BuildCommand, AFailedBuildIsOneLineAndLeavesNothing) {
    const TemporaryFolder folder;
    const std::string dem = small_dem(folder);
    const auto expect_failure = [&](std::vector<std::string> arguments, const std::string& reason) {
        const Outcome outcome = build(std::move(arguments));
        EXPECT_EQ(outcome.exit_code, 1);
        EXPECT_THAT(outcome.error, HasSubstr(reason));
        EXPECT_EQ(std::count(outcome.error.begin(), outcome.error.end(), '\n'), 1) << outcome.error;
        EXPECT_EQ(outcome.out, "");
        for (const auto& entry : std::filesystem::directory_iterator(folder.path(""))) {
            EXPECT_NE(entry.path().filename().string().substr(0, 2), "db") << entry.path();
        }
    };
    expect_failure({"--dem", folder.path("absent.tif"), "-o", folder.path("db")},
                   "cannot be read as a raster");
    expect_failure({"--dem", dem, "--extent", "9,46,8,47", "-o", folder.path("db")}, "is no extent");
    expect_failure({"--dem", dem, "-o", "/proc/db"}, "/proc");
    RasterFile far{.columns = 8,
                   .rows = 8,
                   .bands = 3,
                   .pixel = Pixel::Byte,
                   .geotransform = testing::posts_from(100.0, -20.0, 0.01),
                   .epsg = 4326,
                   .nodata = std::nullopt,
                   .driver = "GTiff"};
    testing::write_raster(folder.path("far.tif"), far, [](int, int, int) { return 90.0; });
    expect_failure({"--dem", dem, "--imagery", folder.path("far.tif"), "-o", folder.path("db")},
                   "lies over none of the elevation");
}

TEST(BuildCommand, StopsAtTheDepthAskedFor) {
    const TemporaryFolder folder;
    ASSERT_EQ(build({"--dem", small_dem(folder), "-o", folder.path("db"), "--max-depth", "7"}).exit_code, 0);
    EXPECT_EQ(terrain::Database::open(folder.path("db"))->manifest().max_depth, 7U);
}

}  // namespace
}  // namespace eyepoint::tools
