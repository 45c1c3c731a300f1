/// Codes against geometry: neighbours found by looking for shared edges among all triangles of a level.
#include "terrain/lod/bintree/code.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include <gtest/gtest.h>

namespace eyepoint::terrain::bintree {
namespace {

constexpr int kDeepest = 14;
constexpr int kCells = 128;  ///< 2^(kDeepest / 2): triangles of level 14 are half cells
constexpr std::array kSides{Side::Left, Side::Right, Side::Base};

using Point = std::pair<int, int>;  ///< row, column, in cells of one block; several blocks lie side by side
using Ends = std::pair<Point, Point>;

Point at(Post post, Point block) {
    return {post.row + block.first * kCells, post.column + block.second * kCells};
}

Ends ends(const Corners& triangle, Side side, Point block) {
    const Point apex = at(triangle.apex, block), left = at(triangle.left, block),
                right = at(triangle.right, block);
    if (side == Side::Left) return std::minmax(apex, left);
    if (side == Side::Right) return std::minmax(apex, right);
    return std::minmax(left, right);
}

/// The block in the middle of three by three, and the blocks across its edges.
constexpr Point kMiddle{1, 1};
Point across(Edge edge) {
    switch (edge) {
        case Edge::West:
            return {1, 0};
        case Edge::East:
            return {1, 2};
        case Edge::South:
            return {0, 1};
        case Edge::North:
            return {2, 1};
    }
    return kMiddle;
}

struct Holder {
    Point block;
    Code code = 0;
};

class BintreeCode : public ::testing::TestWithParam<Diagonal> {};

TEST_P(BintreeCode, EveryNeighbourIsTheTriangleThatSharesTheSideToLevel14) {
    const Diagonal diagonal = GetParam();
    for (int depth = 0; depth <= kDeepest; ++depth) {
        // All triangles of the level in the block and the four beside it, by the ends of their sides.
        std::multimap<Ends, Holder> holders;
        const Code first = Code{2} << depth, end = first * 2;
        const auto enter = [&](Point block, Diagonal cut) {
            for (Code code = first; code < end; ++code) {
                for (const Side side : kSides)
                    holders.emplace(ends(corners(code, cut, kCells), side, block), Holder{block, code});
            }
        };
        enter(kMiddle, diagonal);
        for (const Edge edge : kEdges) enter(across(edge), other(diagonal));

        for (Code code = first; code < end; ++code) {
            ASSERT_EQ(level(code), depth);
            for (const Side side : kSides) {
                const Neighbour found = neighbour(code, side, diagonal);
                const Point block = found.across ? across(*found.across) : kMiddle;
                const auto [from, to] =
                    holders.equal_range(ends(corners(code, diagonal, kCells), side, kMiddle));
                ASSERT_EQ(std::distance(from, to), 2) << "code " << code;
                const auto beside = std::find_if(from, to, [&](const auto& holder) {
                    return holder.second.block != kMiddle || holder.second.code != code;
                });
                ASSERT_EQ(found.code, beside->second.code) << "code " << code;
                ASSERT_EQ(block, beside->second.block) << "code " << code;
            }
        }
    }
}

TEST_P(BintreeCode, ATriangleIsItsTwoChildrenTurnedTheSameWay) {
    const auto twice_area = [](const Corners& t) {
        return (t.left.column - t.apex.column) * (t.right.row - t.apex.row) -
               (t.right.column - t.apex.column) * (t.left.row - t.apex.row);
    };
    for (Code code = kRootA; code < (Code{2} << kDeepest); ++code) {
        const Corners whole = corners(code, GetParam(), kCells);
        const Corners left = corners(left_child(code), GetParam(), kCells);
        const Corners right = corners(right_child(code), GetParam(), kCells);
        ASSERT_EQ(parent(left_child(code)), code);
        ASSERT_EQ(parent(right_child(code)), code);
        ASSERT_GT(twice_area(left), 0);
        ASSERT_EQ(twice_area(left), twice_area(right));
        ASSERT_EQ(twice_area(left) * 2, twice_area(whole));
        ASSERT_EQ(left.apex, middle(whole));
        ASSERT_EQ(right.apex, middle(whole));
        ASSERT_EQ(left.right, whole.left);
        ASSERT_EQ(right.left, whole.right);
        ASSERT_EQ(left.left, whole.apex);
        ASSERT_EQ(right.right, whole.apex);
    }
}

TEST_P(BintreeCode, ANodeOfLevel2OrMoreIsTheSameTriangleInAChildBlock) {
    const TileId block{3, GetParam() == Diagonal::Rising ? 4U : 5U, 2};
    ASSERT_EQ(diagonal_of(block), GetParam());
    for (Code code = 8; code < (Code{4} << kDeepest); ++code) {
        const ChildNode node = in_child(code, GetParam());
        ASSERT_EQ(level(node.code), level(code) - 2);
        ASSERT_EQ(in_parent(node, GetParam()), code);
        if (level(code) > kDeepest) continue;
        const Corners here = corners(code, GetParam(), kCells);
        const Corners there = corners(node.code, diagonal_of(child(block, node.quadrant)), kCells);
        const auto in_block = [&](Post post) {
            return Post{(post.row + (node.quadrant >> 1) * kCells) / 2,
                        (post.column + (node.quadrant & 1) * kCells) / 2};
        };
        ASSERT_EQ(here.apex, in_block(there.apex)) << "code " << code;
        ASSERT_EQ(here.left, in_block(there.left)) << "code " << code;
        ASSERT_EQ(here.right, in_block(there.right)) << "code " << code;
    }
}

INSTANTIATE_TEST_SUITE_P(Diagonals, BintreeCode, ::testing::Values(Diagonal::Rising, Diagonal::Falling),
                         [](const auto& diagonal) {
                             return diagonal.param == Diagonal::Rising ? "Rising" : "Falling";
                         });

TEST(BintreeDiagonal, BlocksAcrossAnEdgeAreCutTheOtherWayAlsoOverTheAntimeridian) {
    for (const TileId tile : {TileId{0, 0, 0}, TileId{4, 7, 3}, TileId{4, 31, 5}, TileId{4, 0, 6}}) {
        for (const Edge edge : kEdges) {
            const auto beside = terrain::neighbour(tile, edge);
            if (!beside) continue;
            EXPECT_NE(diagonal_of(tile), diagonal_of(*beside));
        }
    }
}

}  // namespace
}  // namespace eyepoint::terrain::bintree
