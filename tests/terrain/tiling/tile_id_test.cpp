#include "terrain/tiling/tile_id.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace eyepoint::terrain {
namespace {

TileId any_tile() {
    const auto depth = *rc::gen::inRange<std::uint32_t>(0, kMaxDepth + 1);
    return {depth, *rc::gen::inRange<std::uint32_t>(0, tiles_across(depth)),
            *rc::gen::inRange<std::uint32_t>(0, tiles_up(depth))};
}

TEST(TileId, RootsAreTheTwoHemispheres) {
    const GeographicExtent west = extent({0, 0, 0}), east = extent({0, 1, 0});
    EXPECT_EQ(west.west_deg, -180.0);
    EXPECT_EQ(west.east_deg, 0.0);
    EXPECT_EQ(east.east_deg, 180.0);
    EXPECT_EQ(east.south_deg, -90.0);
    EXPECT_EQ(east.north_deg, 90.0);
}

TEST(TileId, NeighbourAcrossTheAntimeridianWraps) {
    EXPECT_EQ(neighbour({3, 15, 2}, Edge::East), (TileId{3, 0, 2}));
    EXPECT_EQ(neighbour({3, 0, 2}, Edge::West), (TileId{3, 15, 2}));
    EXPECT_EQ(neighbour({3, 0, 7}, Edge::North), std::nullopt);
    EXPECT_EQ(neighbour({3, 0, 0}, Edge::South), std::nullopt);
}

TEST(TileId, TheAntimeridianHasOneLongitudeFromBothSides) {
    EXPECT_EQ(post_longitude_deg({4, 31, 5}, kBlockCells), -180.0);
    EXPECT_EQ(post_longitude_deg({4, 0, 5}, 0), -180.0);
}

RC_GTEST_PROP(TileId, ChildrenAndParentUndoEachOther, ()) {
    const TileId tile = any_tile();
    RC_PRE(tile.depth < kMaxDepth);
    for (int q = 0; q < 4; ++q) {
        RC_ASSERT(parent(child(tile, q)) == tile);
        RC_ASSERT(quadrant(child(tile, q)) == q);
    }
}

RC_GTEST_PROP(TileId, SharedPostsHaveEqualCoordinatesInEveryTileThatHasThem, ()) {
    const TileId tile = any_tile();
    RC_PRE(tile.depth < kMaxDepth);
    const int row = *rc::gen::inRange(0, kBlockPosts), column = *rc::gen::inRange(0, kBlockPosts);
    const int q = (column > 16 ? 1 : 0) + (row > 16 ? 2 : 0);
    const TileId below = child(tile, q);
    RC_ASSERT(post_latitude_deg(tile, row) == post_latitude_deg(below, row * 2 - (q / 2) * kBlockCells));
    RC_ASSERT(post_longitude_deg(tile, column) ==
              post_longitude_deg(below, column * 2 - (q % 2) * kBlockCells));
    const TileId east = *neighbour(tile, Edge::East);
    RC_ASSERT(post_longitude_deg(tile, kBlockCells) == post_longitude_deg(east, 0));
}

RC_GTEST_PROP(TileId, TileAtHoldsThePlace, ()) {
    const double latitude = *rc::gen::inRange(-900000, 900000) / 10000.0;
    const double longitude = *rc::gen::inRange(-1800000, 1800000) / 10000.0;
    const GeographicExtent area =
        extent(tile_at(latitude, longitude, *rc::gen::inRange<std::uint32_t>(0, 20)));
    RC_ASSERT(area.south_deg <= latitude && latitude < area.north_deg);
    RC_ASSERT(area.west_deg <= longitude && longitude < area.east_deg);
}

RC_GTEST_PROP(TileId, KeysAreUnique, ()) {
    const TileId a = any_tile(), b = any_tile();
    RC_ASSERT((key(a) == key(b)) == (a == b));
}

TEST(TileId, PlacesOnThePolesAndBeyondATurnHaveATile) {
    EXPECT_EQ(tile_at(90.0, 0.0, 5), (TileId{5, 32, 31}));
    EXPECT_EQ(tile_at(-90.0, -180.0, 5), (TileId{5, 0, 0}));
    EXPECT_EQ(tile_at(10.0, 540.0, 5), tile_at(10.0, -180.0, 5));
}

}  // namespace
}  // namespace eyepoint::terrain
