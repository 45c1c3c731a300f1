#include "terrain/block/block.hpp"

#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "terrain/geodesy/earth.hpp"

namespace eyepoint::terrain {
namespace {

glm::dvec3 position(const BlockVertex& vertex) {
    return {static_cast<double>(vertex.high[0]) + vertex.low[0],
            static_cast<double>(vertex.high[1]) + vertex.low[1],
            static_cast<double>(vertex.high[2]) + vertex.low[2]};
}

double field(std::uint32_t packed, int shift) {
    const auto raw = static_cast<std::int32_t>((packed >> shift) & 0x3ffU);
    return (raw >= 512 ? raw - 1024 : raw) / 511.0;
}
glm::dvec3 normal(const BlockVertex& vertex) {
    return {field(vertex.normal, 0), field(vertex.normal, 10), field(vertex.normal, 20)};
}

/// A tile whose surface rises to the east by a given slope.
BlockData slope_to_the_east(TileId tile, double rise_per_post_m) {
    BlockData data;
    data.tile = tile;
    for (int row = -1; row <= kBlockPosts; ++row) {
        for (int column = -1; column <= kBlockPosts; ++column) {
            data.heights_m[static_cast<std::size_t>((row + 1) * kApronPosts + column + 1)] =
                static_cast<float>(rise_per_post_m * column);
        }
    }
    data.undulation_m = {50.0F, 50.0F, 50.0F, 50.0F};
    return data;
}

TEST(Block, VerticesStandOnTheEarthToTheMicrometre) {
    const TileId tile = tile_at(46.5, 8.2, 14);
    const auto block = unfold(slope_to_the_east(tile, 2.0), std::nullopt);
    for (const int index : {0, 32, 500, kBlockVertices - 1}) {
        const int row = index / kBlockPosts, column = index % kBlockPosts;
        const Ecef want = to_ecef({post_latitude_deg(tile, row), post_longitude_deg(tile, column),
                                   EllipsoidalHeight{2.0 * column}});
        EXPECT_LT(glm::distance(position(block->vertices[static_cast<std::size_t>(index)]), want), 1e-6);
    }
}

TEST(Block, NormalLeansAwayFromTheRise) {
    const TileId tile = tile_at(0.0, 20.0, 14);
    const double spacing_m = post_spacing_deg(14) * 111319.5;
    const auto block = unfold(slope_to_the_east(tile, spacing_m), std::nullopt);  // 45 degrees
    const auto& middle = block->vertices[16 * kBlockPosts + 16];
    const glm::dmat3 enu = east_north_up(post_latitude_deg(tile, 16), post_longitude_deg(tile, 16));
    const glm::dvec3 want = glm::normalize(enu[2] - enu[0]);
    EXPECT_GT(glm::dot(glm::normalize(normal(middle)), want), std::cos(0.01));
}

TEST(Block, SurfaceHoldsHeightAboveTheSeaAndWater) {
    BlockData data = slope_to_the_east(tile_at(46.5, 8.2, 14), 10.0);
    data.water[5] = 1;
    const auto block = unfold(data, std::nullopt);
    const std::uint32_t surface = block->vertices[5].surface;
    EXPECT_NEAR((surface & 0xffffU) * kSurfaceStepM + kSurfaceFloorM, 50.0 - 50.0, kSurfaceStepM / 2);
    EXPECT_EQ(surface >> 16, 1U);
    EXPECT_EQ(block->vertices[6].surface >> 16, 0U);
}

TEST(Block, TheSumOfASplitPositionIsExactToTenNanometres) {
    for (const double x : {6378137.123456789, -4215000.987654321, 1e-3, 0.0}) {
        const SplitPosition parts = split({x, -x, x / 3.0});
        EXPECT_NEAR(static_cast<double>(parts.high[0]) + parts.low[0], x, 1e-8);
        EXPECT_NEAR(static_cast<double>(parts.high[2]) + parts.low[2], x / 3.0, 1e-8);
    }
}

}  // namespace
}  // namespace eyepoint::terrain
