#include "terrain/lod/selective/dependency_hierarchy.hpp"

#include <algorithm>
#include <array>
#include <set>

#include <gtest/gtest.h>

namespace eyepoint::terrain::selective {
namespace {

const DependencyHierarchy& whole_hierarchy() { return DependencyHierarchy::of_block(); }

bool on_border(int post) {
    const int row = post / kBlockPosts, column = post % kBlockPosts;
    return row == 0 || column == 0 || row == kBlockCells || column == kBlockCells;
}

TEST(DependencyHierarchy, HasEveryPostButTheCornersOnceTheFinestLevelFirst) {
    std::set<int> posts;
    int level = kLevels - 1;
    for (const HierarchyVertex& vertex : whole_hierarchy().vertices()) {
        EXPECT_LE(vertex.level, level);
        level = vertex.level;
        posts.insert(vertex.post);
    }
    EXPECT_EQ(posts.size(), kRanks);
    EXPECT_EQ(level, 1);
    for (const int corner : {0, kBlockCells, kBlockPosts * kBlockCells, kBlockVertices - 1}) {
        EXPECT_FALSE(posts.contains(corner));
        EXPECT_EQ(whole_hierarchy().rank_of(static_cast<std::uint16_t>(corner)), kNoRank);
    }
}

/// The paper's figure 1, continued: the centres of 4^i squares at odd levels, the middles of their sides at
/// even ones.
TEST(DependencyHierarchy, LevelsAreThoseOfTheRegularSquareGrid) {
    std::array<int, kLevels> counts{};
    for (const HierarchyVertex& vertex : whole_hierarchy().vertices()) ++counts[vertex.level];
    EXPECT_EQ(counts, (std::array<int, kLevels>{0, 1, 4, 4, 12, 16, 40, 64, 144, 256, 544}));
}

TEST(DependencyHierarchy, AVertexHasTwoParentsOfTheLevelBeforeAndOneOnTheBorder) {
    for (const HierarchyVertex& vertex : whole_hierarchy().vertices()) {
        const auto count = std::count_if(vertex.parents.begin(), vertex.parents.end(),
                                         [](Rank parent) { return parent != kNoRank; });
        const bool beside_corners = vertex.level <= 1;
        EXPECT_EQ(count, beside_corners ? 0 : on_border(vertex.post) ? 1 : 2) << vertex.post;
        for (const Rank parent : vertex.parents) {
            if (parent != kNoRank) {
                EXPECT_EQ(whole_hierarchy().vertices()[parent].level + 1, vertex.level);
            }
        }
    }
}

TEST(DependencyHierarchy, AVertexIsParentOfThoseThatSplitItsTriangles) {
    for (Rank rank = 0; rank < kRanks; ++rank) {
        const HierarchyVertex& vertex = whole_hierarchy().vertices()[rank];
        EXPECT_EQ(vertex.triangle_count, on_border(vertex.post) ? 2 : 4);
        for (std::size_t t = 0; t < vertex.triangle_count; ++t) {
            const TreeTriangle& triangle = vertex.triangles[t];
            EXPECT_EQ(triangle.vertices[0], vertex.post);
            EXPECT_EQ(triangle.middle == kNoRank, vertex.level == kLevels - 1);
            if (triangle.middle == kNoRank) continue;
            const auto& parents = whole_hierarchy().vertices()[triangle.middle].parents;
            EXPECT_NE(std::find(parents.begin(), parents.end(), rank), parents.end());
        }
    }
}

TEST(DependencyHierarchy, BorderVerticesKnowTheirPlaceOnTheirEdge) {
    std::array<std::uint32_t, kInside + 1> all{};
    for (const HierarchyVertex& vertex : whole_hierarchy().vertices()) {
        EXPECT_EQ(vertex.edge == kInside, !on_border(vertex.post));
        all[vertex.edge] |= vertex.border_bit;
    }
    for (std::size_t edge = 0; edge < kInside; ++edge) EXPECT_EQ(all[edge], 0xffff'fffeU);
}

}  // namespace
}  // namespace eyepoint::terrain::selective
