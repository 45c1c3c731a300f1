#include "terrain/lod/tile/tile_mesh.hpp"

#include <map>

#include <gtest/gtest.h>

namespace eyepoint::terrain {
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

/// Posts of one edge that a mesh uses, as distances from its start.
std::vector<int> west_edge_posts(const TileMeshes& meshes, IndexRange range) {
    std::map<int, int> rows;
    for (std::uint32_t i = range.first; i < range.first + range.count; ++i) {
        const int index = meshes.indices()[i];
        if (index % kBlockPosts == 0) ++rows[index / kBlockPosts];
    }
    std::vector<int> posts;
    for (const auto& [row, uses] : rows) posts.push_back(row);
    return posts;
}

TEST(TileMeshes, EveryMeshCoversItsBlockOnceWithoutFolds) {
    const TileMeshes meshes;
    for (int level = 0; level < kTileLevels; ++level) {
        for (int set = 0; set < kHalfEdgeSets; ++set) {
            const Sums sums = sum_areas(meshes, meshes.range(level, static_cast<std::uint8_t>(set)));
            ASSERT_EQ(sums.twice_area, 2 * kBlockCells * kBlockCells) << "level " << level << " set " << set;
            ASSERT_GT(sums.smallest, 0) << "level " << level << " set " << set;
        }
    }
}

TEST(TileMeshes, TriangleCountOfAnUnthinnedLevelIsTwoACell) {
    const TileMeshes meshes;
    EXPECT_EQ(meshes.range(0, 0).count, 3U * 2 * 32 * 32);
    EXPECT_EQ(meshes.range(3, 0).count, 3U * 2 * 4 * 4);
}

TEST(TileMeshes, ThinnedHalvesHaveTheNextLevelsPosts) {
    const TileMeshes meshes;
    const auto south_half = static_cast<std::uint8_t>(1U << static_cast<int>(HalfEdge::WestSouth));
    const auto whole = static_cast<std::uint8_t>(south_half | 1U << static_cast<int>(HalfEdge::WestNorth));
    EXPECT_EQ(west_edge_posts(meshes, meshes.range(2, 0)),
              (std::vector<int>{0, 4, 8, 12, 16, 20, 24, 28, 32}));
    EXPECT_EQ(west_edge_posts(meshes, meshes.range(2, whole)), (std::vector<int>{0, 8, 16, 24, 32}));
    EXPECT_EQ(west_edge_posts(meshes, meshes.range(2, south_half)),
              (std::vector<int>{0, 8, 16, 20, 24, 28, 32}));
    EXPECT_EQ(west_edge_posts(meshes, meshes.range(3, south_half)), (std::vector<int>{0, 16, 24, 32}));
}

}  // namespace
}  // namespace eyepoint::terrain
