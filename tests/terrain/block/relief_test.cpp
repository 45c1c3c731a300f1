#include "terrain/block/relief.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/terrain/lod/pattern_planet.hpp"

namespace eyepoint::terrain {
namespace {

constexpr double kMetresPerDegree = 6378137.0 * 3.14159265358979323846 / 180.0;

double component(ReliefPost post, int shift) {
    const auto raw = static_cast<int>(post >> shift & 0xfffU);
    return (raw >= 2048 ? raw - 4096 : raw) / kReliefUnits;
}
double east_of(ReliefPost post) { return component(post, 0); }
double north_of(ReliefPost post) { return component(post, 12); }

std::size_t at(int row, int column) { return static_cast<std::size_t>(row * kBlockPosts + column); }

/// A tile whose surface rises by so much a post to the east and to the north.
BlockData slope(TileId tile, double east_m, double north_m) {
    BlockData data;
    data.tile = tile;
    for (int row = -1; row <= kBlockPosts; ++row) {
        for (int column = -1; column <= kBlockPosts; ++column) {
            data.heights_m[static_cast<std::size_t>((row + 1) * kApronPosts + column + 1)] =
                static_cast<float>(east_m * column + north_m * row);
        }
    }
    return data;
}

TEST(Relief, LeansAwayFromTheRise) {
    const double spacing_m = post_spacing_deg(14) * kMetresPerDegree;
    const auto flat = relief_of(slope(tile_at(0.0, 20.0, 14), 0.0, 0.0));
    EXPECT_EQ(flat[at(16, 16)], 0U);
    const auto east = relief_of(slope(tile_at(0.0, 20.0, 14), spacing_m, 0.0));  // 45 degrees
    EXPECT_NEAR(east_of(east[at(16, 16)]), -std::sqrt(0.5), 1e-3);
    EXPECT_NEAR(north_of(east[at(16, 16)]), 0.0, 1e-3);
    const auto south = relief_of(slope(tile_at(0.0, 20.0, 14), 0.0, -2.0 * spacing_m));
    EXPECT_NEAR(north_of(south[at(16, 16)]), 2.0 / std::sqrt(5.0), 1e-3);
}

TEST(Relief, TheSameRiseAPostIsSteeperToTheEastFarFromTheEquator) {
    const double spacing_m = post_spacing_deg(14) * kMetresPerDegree;
    const auto relief = relief_of(slope(tile_at(60.0, 20.0, 14), 0.1 * spacing_m, 0.1 * spacing_m));
    EXPECT_NEAR(east_of(relief[at(16, 16)]) / north_of(relief[at(16, 16)]), 2.0, 0.02);
}

TEST(Relief, IsFiniteAtAPoleAndOnWalls) {
    const auto relief = relief_of(slope({3, 5, 7}, 1000.0, 9000.0));
    for (int column = 0; column < kBlockPosts; ++column) {
        const ReliefPost post = relief[at(kBlockPosts - 1, column)];
        EXPECT_LE(std::hypot(east_of(post), north_of(post)), 1.001);
    }
}

TEST(Relief, TilesOfADepthAgreeOnTheirEdge) {
    const TileId west = tile_at(46.5, 8.2, 9), east{west.depth, west.x + 1, west.y};
    const auto from_west = relief_of(testing::pattern_block(west)),
               from_east = relief_of(testing::pattern_block(east));
    for (int row = 0; row < kBlockPosts; ++row)
        EXPECT_EQ(from_west[at(row, kBlockPosts - 1)], from_east[at(row, 0)]) << row;
}

TEST(Relief, HoldsWater) {
    BlockData data = slope(tile_at(46.5, 8.2, 14), 0.0, 0.0);
    data.water[at(3, 7)] = 1;
    const auto relief = relief_of(data);
    EXPECT_EQ(relief[at(3, 7)] >> 24, 255U);
    EXPECT_EQ(relief[at(7, 3)] >> 24, 0U);
}

}  // namespace
}  // namespace eyepoint::terrain
