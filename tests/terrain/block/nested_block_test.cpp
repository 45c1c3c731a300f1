#include <algorithm>
#include <cstring>
#include <set>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "terrain/block/block.hpp"
#include "terrain/database/virtual_tile.hpp"
#include "tests/terrain/lod/pattern_planet.hpp"

namespace eyepoint::terrain {
namespace {

using testing::pattern_block;
using testing::pattern_mesh;
using testing::pattern_node;
using testing::PatternPlanet;

constexpr PatternPlanet kPlanet{};

std::shared_ptr<const Block> unfolded(TileId tile) {
    const auto above = tile.depth == 0 ? nullptr : unfolded(parent(tile));
    return unfold(pattern_block(tile), pattern_node(kPlanet, tile.depth), pattern_mesh(kPlanet, tile),
                  above.get(), std::nullopt);
}

bool same_place(const BlockVertex& a, const BlockVertex& b) {
    return std::memcmp(a.high.data(), b.high.data(), sizeof(a.high)) == 0 &&
           std::memcmp(a.low.data(), b.low.data(), sizeof(a.low)) == 0;
}

/// A mesh of two triangles over four own corners, and a fan of one fine post in the middle of the western
/// edge.
NestedMesh fan_at(std::uint32_t x, std::uint32_t y, float height_m) {
    NestedMesh mesh;
    mesh.posts = {0, 32, 32 * 33, 32 * 33 + 32};
    mesh.fine_posts = {{x, y, height_m}};
    mesh.triangles = {0, 1, 4, 1, 3, 4, 3, 2, 4};
    mesh.gone_level.assign(5, NestedMesh::kStays);
    mesh.target.assign(5, 0);
    return mesh;
}

TEST(NestedBlock, AFinePostHasTheBitsOfTheDeeperTilesOwnPost) {
    for (const TileId tile : {tile_at(46.5, 8.2, 3), TileId{3, 15, 5}, TileId{3, 0, 7}}) {
        const TileId below = child(child(tile, 1), 3);  // on the eastern edge of the southern half's middle
        const BlockData data = pattern_block(below);
        for (const int row : {1, 7, 31}) {
            for (const int column : {3, 31, 32}) {
                const std::uint32_t unit = kPlaceUnits / kBlockCells / 4;
                const std::uint32_t x = (kBlockCells * 3 + static_cast<std::uint32_t>(column)) * unit;
                const std::uint32_t y = (kBlockCells + static_cast<std::uint32_t>(row)) * unit;
                const auto coarse = unfold(pattern_block(tile), pattern_node(kPlanet, tile.depth),
                                           fan_at(x, y, data.height_m(row, column)), nullptr, std::nullopt);
                const auto fine = unfold(data, std::nullopt);
                EXPECT_TRUE(same_place(coarse->vertices[4],
                                       fine->vertices[static_cast<std::size_t>(row * kBlockPosts + column)]));
            }
        }
    }
}

TEST(NestedBlock, TheAntimeridianAndAPoleHaveOneSetOfBits) {
    const auto last = unfolded({2, 7, 3}), first = unfolded({2, 0, 3});
    for (int row = 0; row < kBlockPosts; ++row) {
        const auto& west_of = last->vertices[static_cast<std::size_t>(row * kBlockPosts + kBlockCells)];
        const auto& east_of = first->vertices[static_cast<std::size_t>(row * kBlockPosts)];
        EXPECT_TRUE(same_place(west_of, east_of)) << row;
        EXPECT_TRUE(same_place(first->vertices[static_cast<std::size_t>(kBlockCells * kBlockPosts + row)],
                               last->vertices[kBlockCells * kBlockPosts]));
    }
}

TEST(NestedBlock, AVertexThatStaysPointsToItselfInTheParent) {
    const TileId tile = tile_at(46.5, 8.2, 3);
    const auto above = unfolded(parent(tile)), block = unfolded(tile);
    int stay = 0;
    for (const BlockVertex& vertex : block->vertices) {
        if (vertex.gone_level() != NestedMesh::kStays) continue;
        ++stay;
        const std::uint32_t there = vertex.next();
        ASSERT_LT(there, above->vertices.size());
        EXPECT_TRUE(same_place(vertex, above->vertices[there]));
    }
    EXPECT_EQ(stay, 17 * 17);
}

TEST(NestedBlock, AFinePostThatStaysIsFoundInTheParentByItsExactPlace) {
    const TileId below = child({2, 3, 2}, 2);
    constexpr std::uint32_t kX = 12345678,
                            kY = 999 * 2;  // in the parent; the child lies in its northern half
    const auto above = unfold(pattern_block({2, 3, 2}), pattern_node(kPlanet, 2),
                              fan_at(kX, kPlaceUnits / 2 + kY, 100.0F), nullptr, std::nullopt);
    const auto block = unfold(pattern_block(below), pattern_node(kPlanet, 3), fan_at(2 * kX, 2 * kY, 100.0F),
                              above.get(), std::nullopt);
    EXPECT_EQ(block->vertices[4].next(), 4U);
    EXPECT_TRUE(same_place(block->vertices[4], above->vertices[4]));
    EXPECT_EQ(block->vertices[0].next(), kNoVertex) << "the parent has no vertex there";
    EXPECT_EQ(block->vertices[2].next(), 2U);
}

TEST(NestedBlock, EveryLevelsListHasTheVerticesThatAreStillThere) {
    const TileId tile = tile_at(46.5, 8.2, 3);
    const auto block = unfolded(tile);
    const NestedMesh mesh = pattern_mesh(kPlanet, tile);
    const auto levels = static_cast<std::size_t>(block->last_level - block->first_level) + 1;
    ASSERT_GE(block->levels.size(), levels);
    EXPECT_EQ(block->levels.front().count(), 32U * 32 * 6);
    EXPECT_EQ(block->levels[levels - 1].count(), 16U * 16 * 6);
    for (std::size_t i = 0; i < levels; ++i) {
        const int level = block->first_level + static_cast<int>(i);
        std::set<std::uint16_t> want, got;
        for (std::uint16_t v = 0; v < kBlockVertices; ++v) {
            if (mesh.gone_level[v] > level) want.insert(v);
        }
        const auto first = block->indices.begin() + block->levels[i].first();
        got.insert(first, first + block->levels[i].count());
        EXPECT_EQ(got, want) << "level " << level;
    }
}

TEST(NestedBlock, ListsAboveTheLastLeaveOutWhatSlidesShutInTheParent) {
    const TileId tile = tile_at(46.5, 8.2, 3);
    const auto above = unfolded(parent(tile)), block = unfolded(tile);
    const NestedMesh mesh = pattern_mesh(kPlanet, parent(tile));
    EXPECT_EQ(block->last_list_level(),
              std::min(block->last_level + CellBoxes::kLevelsBeyond, int{above->last_level}));
    // A triangle by its corners' places in the parent's mesh when a level has come.
    const auto places_at = [&](std::span<const std::uint16_t> triangle, int level) {
        std::set<std::uint16_t> places;
        for (const std::uint16_t corner : triangle) {
            std::uint16_t there = block->vertices[corner].next();
            while (mesh.gone_level[there] <= level) there = mesh.target[there];
            places.insert(there);
        }
        return places.size();
    };
    const std::span indices{block->indices};
    const auto list_of = [&](int level) {
        const NestedLevel& list = block->levels[static_cast<std::size_t>(level - block->first_level)];
        return indices.subspan(list.first(), list.count());
    };
    const auto last = list_of(block->last_level);
    for (int level = block->last_level + 1; level <= block->last_list_level(); ++level) {
        std::vector<std::uint16_t> want;
        for (std::size_t i = 0; i < last.size(); i += 3) {
            const auto triangle = last.subspan(i, 3);
            if (places_at(triangle, level) == 3) want.insert(want.end(), triangle.begin(), triangle.end());
        }
        const auto got = list_of(level);
        EXPECT_TRUE(std::ranges::equal(got, want)) << "level " << level;
        EXPECT_LT(got.size(), last.size());
        EXPECT_GT(got.size(), 0U);
    }
}

TEST(NestedBlock, WithoutItsVerticesInTheParentABlockHasNoListsAboveTheLast) {
    const TileId below = child({2, 3, 2}, 2);
    const auto above = unfold(pattern_block({2, 3, 2}), pattern_node(kPlanet, 2), fan_at(0, 0, 100.0F),
                              nullptr, std::nullopt);
    const auto block = unfold(pattern_block(below), pattern_node(kPlanet, 3), fan_at(0, 998, 100.0F),
                              above.get(), std::nullopt);
    EXPECT_EQ(block->last_list_level(), int{block->last_level});
}

TEST(NestedBlock, CellsFollowOneAnotherAndHoldTheirTriangles) {
    const auto block = unfolded(tile_at(46.5, 8.2, 3));
    for (const NestedLevel& level : block->levels) {
        ASSERT_TRUE(std::is_sorted(level.cell_first.begin(), level.cell_first.end()));
        EXPECT_EQ(level.cell_first[0] % 3, 0U);
    }
    const NestedLevel& finest = block->levels.front();
    for (std::size_t cell = 0; cell < finest.cell_first.size() - 1; ++cell) {
        EXPECT_EQ(finest.cell_first[cell + 1] - finest.cell_first[cell], 4U * 4 * 2 * 3);
        for (std::uint32_t i = finest.cell_first[cell]; i < finest.cell_first[cell + 1]; ++i) {
            const std::size_t row = block->indices[i] / 33U, column = block->indices[i] % 33U;
            EXPECT_TRUE(row / 4 == cell / 8 || row == 4 * (cell / 8) + 4);
            EXPECT_TRUE(column / 4 == cell % 8 || column == 4 * (cell % 8) + 4);
        }
    }
}

TEST(NestedBlock, WhatGoesAtTheFirstLevelIsInNoList) {
    const TileId tile = tile_at(46.5, 8.2, 3);
    NestedMesh mesh = pattern_mesh(kPlanet, tile);
    const NodeInfo info = pattern_node(kPlanet, 3);
    mesh.gone_level[1] = info.first_level;
    const auto block = unfold(pattern_block(tile), info, mesh, nullptr, std::nullopt);
    EXPECT_EQ(std::count(block->indices.begin(), block->indices.end(), std::uint16_t{1}), 0);
    EXPECT_EQ(block->levels.front().count(), (32U * 32 * 2 - 1) * 3);
}

TEST(NestedBlock, SidesSayWhichEdgesAVertexIsOn) {
    const auto block = unfolded(tile_at(46.5, 8.2, 3));
    const auto edges = [&](int row, int column) {
        return block->vertices[static_cast<std::size_t>(row * kBlockPosts + column)].sides();
    };
    EXPECT_EQ(edges(0, 0), 0b0101);
    EXPECT_EQ(edges(32, 32), 0b1010);
    EXPECT_EQ(edges(5, 0), 0b0001);
    EXPECT_EQ(edges(5, 32), 0b0010);
    EXPECT_EQ(edges(0, 5), 0b0100);
    EXPECT_EQ(edges(32, 5), 0b1000);
    EXPECT_EQ(edges(5, 5), 0);
}

}  // namespace
}  // namespace eyepoint::terrain
