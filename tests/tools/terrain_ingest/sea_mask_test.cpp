// Which posts at or below 0 m are sea.
#include "tools/terrain/sea_mask.hpp"

#include <numeric>

#include <gtest/gtest.h>

#include "tests/tools/terrain_ingest/raster_files.hpp"

namespace eyepoint::tools {
namespace {

int count(const std::vector<std::uint8_t>& sea) { return std::accumulate(sea.begin(), sea.end(), 0); }

HeightGrid coast(double low_m) {
    // The western half at low_m, every eighth post of it at -1 m, the rest at 20 m.
    return testing::grid_of(16, 16, 0.0, 1.0, 0.05, [&](int column, int row) {
        if (column >= 8) return 20.0;
        return (column + row) % 8 == 0 ? low_m - 1.0 : low_m;
    });
}

TEST(SeaMask, FlatZerosWithSmallNegativesAreSea) {
    EXPECT_EQ(count(find_sea(coast(0.0), SeaRule::Auto)), 128);
}

TEST(SeaMask, LandBelowSeaLevelStaysLand) {
    EXPECT_EQ(count(find_sea(coast(-4.0), SeaRule::Auto)), 0) << "a polder";
    EXPECT_EQ(count(find_sea(coast(-120.0), SeaRule::Auto)), 0) << "Danakil";
    EXPECT_EQ(count(find_sea(coast(-430.0), SeaRule::Auto)), 0) << "the shore of the Dead Sea";
}

TEST(SeaMask, BathymetryIsSeaUpToItsShore) {
    const auto shelf =
        testing::grid_of(20, 4, 0.0, 1.0, 0.05, [](int column, int) { return 50.0 - 40.0 * column; });
    // 50, 10, -30, ... -710: everything at or below 0 belongs to the area that reaches -710 m.
    EXPECT_EQ(count(find_sea(shelf, SeaRule::Auto)), 18 * 4);
}

TEST(SeaMask, AreasAreJudgedOneByOne) {
    const auto two = testing::grid_of(21, 5, 0.0, 1.0, 0.05, [](int column, int) {
        return column < 10 ? 0.0 : column == 10 ? 5.0 : -3.0;
    });
    EXPECT_EQ(count(find_sea(two, SeaRule::Auto)), 50);
}

TEST(SeaMask, AFewZerosInsideLandAreNotSea) {
    const auto plain = testing::grid_of(12, 12, 0.0, 1.0, 0.05, [](int column, int row) {
        return column == 5 && (row == 5 || row == 6) ? 0.0 : 1.0;
    });
    EXPECT_EQ(count(find_sea(plain, SeaRule::Auto)), 0);
}

TEST(SeaMask, DiagonalPostsAreNotConnected) {
    // Flat sea in one corner touches a hole of -3 m only diagonally.
    const auto corner = testing::grid_of(10, 10, 0.0, 1.0, 0.05, [](int column, int row) {
        if (column < 5 && row < 5) return 0.0;
        return column >= 5 && row >= 5 ? -3.0 : 9.0;
    });
    EXPECT_EQ(count(find_sea(corner, SeaRule::Auto)), 25);
}

TEST(SeaMask, TheRuleCanBeOverridden) {
    EXPECT_EQ(count(find_sea(coast(0.0), SeaRule::None)), 0);
    EXPECT_EQ(count(find_sea(coast(-4.0), SeaRule::Clamp)), 128);
}

TEST(SeaMask, VoidsAreNotSea) {
    const auto grid = testing::grid_of(4, 4, 0.0, 1.0, 0.05, [](int, int) { return std::nan(""); });
    EXPECT_EQ(count(find_sea(grid, SeaRule::Clamp)), 0);
}

}  // namespace
}  // namespace eyepoint::tools
