#include "terrain/lod/hyperblock/point_set.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include "terrain/lod/tile_cut.hpp"
#include "terrain/lod/triangle_arc.hpp"
#include "tests/terrain/lod/hyperblock/patchy_tile.hpp"

namespace eyepoint::terrain::hyperblock {
namespace {

using selective::DependencyHierarchy;
using selective::kNoRank;
using selective::kRanks;

RC_GTEST_PROP(PointSet, EveryPointStandsOnPoints, ()) {
    const testing::PatchyTile tile(*rc::gen::arbitrary<unsigned>(), 2,
                                   *rc::gen::element(1.0F, 50.0F, 400.0F));
    for (std::size_t rank = 0; rank < kRanks; ++rank) {
        if (!tile.points.vertices[rank]) continue;
        for (const auto parent : DependencyHierarchy::of_block().vertices()[rank].parents)
            if (parent != kNoRank) RC_ASSERT(tile.points.vertices[parent]);
    }
}

RC_GTEST_PROP(PointSet, WhatIsLeftOutIsWithinTheTolerance, ()) {
    const float tolerance_m = *rc::gen::element(1.0F, 50.0F, 400.0F);
    const testing::PatchyTile tile(*rc::gen::arbitrary<unsigned>(), 2, tolerance_m);
    for (std::size_t rank = 0; rank < kRanks; ++rank)
        RC_ASSERT(tile.points.vertices[rank] ||
                  tile.posts.bound_m[rank] <= tolerance_m + testing::kPatchyUnseenM + 1e-3F);
}

TEST(PointSet, APlainHasNone) {
    const auto block = terrain::unfold(BlockData{.tile = testing::kPatchyTile}, std::nullopt);
    const selective::BlockPosts posts = selective::block_posts(*block, 0.0F);
    EXPECT_TRUE(point_set(posts, 0.0F, {100.0F, 1e9F}).vertices.none());
}

TEST(PointSet, ATighterToleranceKeepsMore) {
    const testing::PatchyTile coarse(5, 2, 300.0F), fine(5, 2, 30.0F);
    EXPECT_GT(fine.points.vertices.count(), coarse.points.vertices.count());
    EXPECT_TRUE((coarse.points.vertices & ~fine.points.vertices).none());
}

TEST(PointSet, BorderHasThePointsOnTheEdgesLevelByLevel) {
    const testing::PatchyTile tile(3, 2, 20.0F);
    const auto vertices = DependencyHierarchy::of_block().vertices();
    for (int level = 0; level < kQuadLevels; ++level) {
        selective::BorderSelection expected{};
        for (std::size_t rank = 0; rank < kRanks; ++rank) {
            if (vertices[rank].edge < 4 && quad_level(vertices[rank]) <= level && tile.points.vertices[rank])
                expected[vertices[rank].edge] |= vertices[rank].border_bit;
        }
        EXPECT_EQ(tile.points.border[static_cast<std::size_t>(level)], expected) << "level " << level;
    }
}

TEST(PointTolerance, OverTheSeaIsTheArcOfACell) {
    for (const std::uint32_t depth : {3U, 8U, 13U}) {
        const PointTolerance tolerance = point_tolerance({depth, 0, 0}, NodeInfo{});
        EXPECT_FLOAT_EQ(tolerance.surface_m, static_cast<float>(arc_height_m(depth, selective::kLevels - 1)));
        EXPECT_FLOAT_EQ(tolerance.arc_m, tolerance.surface_m);
    }
}

TEST(PointTolerance, IsAsLargeWhereEverySecondPostIsInterpolatedAsOnSmoothGround) {
    const TileId tile{13, 0, 0};
    NodeInfo smooth, interpolated;
    smooth.delta_m = {0.5F, 2.0F, 8.0F, 32.0F};
    interpolated.delta_m = {0.0F, 0.0F, 8.0F, 32.0F};
    EXPECT_FLOAT_EQ(point_tolerance(tile, interpolated).surface_m, point_tolerance(tile, smooth).surface_m);
}

}  // namespace
}  // namespace eyepoint::terrain::hyperblock
