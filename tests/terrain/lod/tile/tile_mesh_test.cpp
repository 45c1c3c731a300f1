#include "terrain/lod/tile/tile_mesh.hpp"

#include <algorithm>
#include <set>

#include <gtest/gtest.h>

namespace eyepoint::terrain::tiles {
namespace {

struct Sums {
    int twice_area = 0;
    int smallest = 1 << 30;
};

Sums sum_areas(const TileMeshes& meshes, IndexRange range) {
    Sums sums;
    for (std::uint32_t i = range.first; i < range.first + range.count; i += 3) {
        const auto column = [&](std::uint32_t c) { return meshes.indices()[i + c] % kBlockPosts; };
        const auto row = [&](std::uint32_t c) { return meshes.indices()[i + c] / kBlockPosts; };
        const int twice =
            (column(1) - column(0)) * (row(2) - row(0)) - (column(2) - column(0)) * (row(1) - row(0));
        sums.twice_area += twice;
        sums.smallest = std::min(sums.smallest, twice);
    }
    return sums;
}

/// Rows of the posts on the block's western edge that a mesh uses.
std::set<int> west_edge_posts(const TileMeshes& meshes, IndexRange range) {
    std::set<int> rows;
    for (std::uint32_t i = range.first; i < range.first + range.count; ++i) {
        const int index = meshes.indices()[i];
        if (index % kBlockPosts == 0) rows.insert(index / kBlockPosts);
    }
    return rows;
}

class TileMeshesOf : public ::testing::TestWithParam<int> {};

TEST_P(TileMeshesOf, EveryMeshCoversItsTileOnceWithoutFolds) {
    const Division parts = division(GetParam());
    const TileMeshes meshes(parts);
    for (int part = 0; part < parts.parts * parts.parts; ++part) {
        for (int level = 0; level < parts.levels; ++level) {
            for (int set = 0; set < kHalfEdgeSets; ++set) {
                // A side of two cells is stitched as a whole: its halves have no post to spare.
                if (level == parts.levels - 1 && ((set ^ (set >> 1)) & 0x55) != 0) continue;
                const Sums sums =
                    sum_areas(meshes, meshes.range(part, level, static_cast<std::uint8_t>(set)));
                ASSERT_EQ(sums.twice_area, 2 * parts.cells * parts.cells)
                    << "part " << part << " level " << level << " set " << set;
                ASSERT_GT(sums.smallest, 0) << "part " << part << " level " << level << " set " << set;
            }
        }
    }
}

TEST_P(TileMeshesOf, AnUnstitchedLevelHasTheTrianglesOfThePaper) {
    // 2^(2 (w - l) + 1) triangles, section 2.
    const Division parts = division(GetParam());
    const TileMeshes meshes(parts);
    for (int level = 0; level < parts.levels; ++level) {
        const auto cells = static_cast<std::uint32_t>(parts.cells >> level);
        EXPECT_EQ(meshes.range(0, level, 0).count, 3 * 2 * cells * cells) << "level " << level;
    }
}

INSTANTIATE_TEST_SUITE_P(Posts, TileMeshesOf, ::testing::Values(9, 17, 33));

TEST(TileMeshes, ABlockIsDividedIntoTilesOfFewerPosts) {
    EXPECT_EQ(division(33).parts, 1);
    EXPECT_EQ(division(33).levels, 5);
    EXPECT_EQ(division(17).parts, 2);
    EXPECT_EQ(division(9).parts, 4);
    EXPECT_EQ(division(9).levels, 3);
}

TEST(TileMeshes, StitchingATwoCellStretchMakesTwoTrianglesOne) {
    // Figure 4: triangles d a b and d b c become d a c.
    const TileMeshes meshes(division(33));
    EXPECT_EQ(meshes.range(0, 0, 0b11).count, meshes.range(0, 0, 0).count - 3 * 16);
}

TEST(TileMeshes, StitchedHalvesHaveTheNextLevelsPosts) {
    const TileMeshes meshes(division(33));
    constexpr std::uint8_t kSouthHalf = 0b01, kWhole = 0b11;  // of the western edge
    EXPECT_EQ(west_edge_posts(meshes, meshes.range(0, 2, 0)),
              (std::set<int>{0, 4, 8, 12, 16, 20, 24, 28, 32}));
    EXPECT_EQ(west_edge_posts(meshes, meshes.range(0, 2, kWhole)), (std::set<int>{0, 8, 16, 24, 32}));
    EXPECT_EQ(west_edge_posts(meshes, meshes.range(0, 2, kSouthHalf)),
              (std::set<int>{0, 8, 16, 20, 24, 28, 32}));
    EXPECT_EQ(west_edge_posts(meshes, meshes.range(0, 4, kWhole)), (std::set<int>{0, 32}));
}

}  // namespace
}  // namespace eyepoint::terrain::tiles
