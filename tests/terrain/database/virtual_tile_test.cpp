#include "terrain/database/virtual_tile.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "terrain/database/interpolate.hpp"
#include "terrain/lod/error_level.hpp"
#include "tests/terrain/database/small_database.hpp"

namespace eyepoint::terrain {
namespace {

constexpr double kHeightStepM = 1.0 / 16.0;

TEST(Midpoint, RoundsDownAlsoBelowTheSea) {
    EXPECT_EQ(midpoint(4, 8), 6);
    EXPECT_EQ(midpoint(4, 7), 5);
    EXPECT_EQ(midpoint(-4, -7), -6);
    EXPECT_EQ(midpoint(2'147'483'647, 2'147'483'645), 2'147'483'646);
}

TEST(VirtualTile, EvenPostsAreTheParents) {
    const BlockData parent = rough_block({4, 3, 9});
    for (int quadrant = 0; quadrant < 4; ++quadrant) {
        const BlockData tile = subdivide(parent, quadrant, kHeightStepM);
        EXPECT_EQ(tile.tile, child(parent.tile, quadrant));
        for (int row = 0; row <= kBlockCells; row += 2) {
            for (int column = 0; column <= kBlockCells; column += 2) {
                ASSERT_EQ(tile.height_m(row, column),
                          parent.height_m(quadrant / 2 * 16 + row / 2, quadrant % 2 * 16 + column / 2));
            }
        }
    }
}

// A plane is linear on any triangles: each post within the half step by which a midpoint is rounded down.
TEST(VirtualTile, APlaneStaysAPlaneApronIncluded) {
    BlockData parent;
    for (int row = -1; row <= kBlockPosts; ++row) {
        for (int column = -1; column <= kBlockPosts; ++column) {
            parent.heights_m[static_cast<std::size_t>((row + 1) * kApronPosts + column + 1)] =
                static_cast<float>(3 * row - 5 * column) / 16.0F;
        }
    }
    const BlockData tile = subdivide(parent, 3, kHeightStepM);
    for (int row = -1; row <= kBlockPosts; ++row) {
        for (int column = -1; column <= kBlockPosts; ++column) {
            const double exact = (3.0 * (16 + row / 2.0) - 5.0 * (16 + column / 2.0)) / 16.0;
            ASSERT_LE(tile.height_m(row, column), exact);
            ASSERT_GE(tile.height_m(row, column), exact - 0.5 / 16.0) << row << " " << column;
        }
    }
}

// The middle of a cell lies on the diagonal from south-west to north-east, not on the other.
TEST(VirtualTile, CellsAreSplitFromSouthWestToNorthEast) {
    BlockData parent;
    parent.heights_m[1 * kApronPosts + 2] = 80.0F;  // row 0, column 1
    EXPECT_EQ(subdivide(parent, 0, kHeightStepM).height_m(1, 1), 0.0F);
    parent.heights_m[1 * kApronPosts + 1] = 80.0F;  // row 0, column 0
    EXPECT_EQ(subdivide(parent, 0, kHeightStepM).height_m(1, 1), 40.0F);
}

TEST(VirtualTile, NeighboursShareTheirEdge) {
    const BlockData parent = rough_block({4, 3, 9});
    const BlockData sw = subdivide(parent, 0, kHeightStepM), se = subdivide(parent, 1, kHeightStepM),
                    nw = subdivide(parent, 2, kHeightStepM);
    for (int post = 0; post < kBlockPosts; ++post) {
        ASSERT_EQ(sw.height_m(post, kBlockCells), se.height_m(post, 0));
        ASSERT_EQ(sw.height_m(kBlockCells, post), nw.height_m(0, post));
    }
}

TEST(VirtualTile, NodeTakesTheParentsLevels) {
    NodeInfo parent = wide_node();
    const NodeInfo node = subdivide(parent, TileId{5, 0, 0});
    EXPECT_EQ(node.delta_m, (std::array<float, kBlockLevels>{0.25F, 1.0F, 2.0F, 3.0F, 4.0F, 5.0F}));
    EXPECT_EQ(node.height_max_m, parent.height_max_m);
    EXPECT_FALSE(node.has_children);
}

// Depth 5 has cells of 180 / 1024 degrees, 27.7 km across: more than triangles of level 35 may be (22.6 km),
// less than those of level 36 (error_level.hpp).
TEST(VirtualTile, NodeHasTheLevelsBelowItsParents) {
    NodeInfo parent = wide_node();
    parent.first_level = bare_level(4, false);
    parent.last_level = 50;
    const NodeInfo node = subdivide(parent, TileId{5, 0, 0});
    EXPECT_EQ(node.last_level, parent.first_level);
    EXPECT_EQ(node.first_level, 36);
    EXPECT_EQ(parent.first_level, 38);
}

TEST(VirtualTile, MeshSlidesTheOddPostsToTheParents) {
    const NestedMesh mesh = virtual_mesh({3, 5, 2}, 12);
    EXPECT_TRUE(mesh.whole_grid);
    ASSERT_EQ(mesh.vertices(), 33U * 33U);
    const auto target = [&](std::size_t row, std::size_t column) { return mesh.target[row * 33 + column]; };
    EXPECT_EQ(target(5, 7), 4 * 33 + 6);
    EXPECT_EQ(target(5, 8), 4 * 33 + 8);
    EXPECT_EQ(target(4, 7), 4 * 33 + 6);
    for (std::size_t post = 0; post < 33U * 33U; ++post) {
        const bool even = post / 33 % 2 == 0 && post % 33 % 2 == 0;
        EXPECT_EQ(mesh.gone_level[post], even ? NestedMesh::kStays : 12);
    }
}

TEST(VirtualTile, UndulationIsBilinear) {
    BlockData parent;
    parent.undulation_m = {0.0F, 4.0F, 8.0F, 20.0F};
    EXPECT_EQ(subdivide(parent, 3, kHeightStepM).undulation_m,
              (std::array<float, 4>{8.0F, 12.0F, 14.0F, 20.0F}));
}

}  // namespace
}  // namespace eyepoint::terrain
