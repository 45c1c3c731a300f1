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

TEST(Block, AVertexHoldsItsHeightAboveTheSea) {
    const auto block = unfold(slope_to_the_east(tile_at(46.5, 8.2, 14), 10.0), std::nullopt);
    EXPECT_NEAR(block->vertices[5].height_msl_m(), 50.0 - 50.0, 0.5);
    EXPECT_NEAR(block->vertices[32].height_msl_m(), 320.0 - 50.0, 0.5);
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
