#include "terrain/lod/bintree/split_vertices.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "terrain/lod/bintree/block_triangles.hpp"
#include "terrain/lod/triangle_arc.hpp"
#include "tests/terrain/lod/rough_block.hpp"

namespace eyepoint::terrain::bintree {
namespace {

struct Triangle {
    Corners at;
    /// Weights of the corners at a post: barycentric, by areas.
    [[nodiscard]] glm::dvec3 weights(Post post) const {
        const auto area = [](Post a, Post b, Post c) {
            return double((b.column - a.column) * (c.row - a.row) - (c.column - a.column) * (b.row - a.row));
        };
        return glm::dvec3{area(post, at.left, at.right), area(at.apex, post, at.right),
                          area(at.apex, at.left, post)} /
               area(at.apex, at.left, at.right);
    }
};

class SplitVerticesOf : public ::testing::TestWithParam<TileId> {
  protected:
    std::shared_ptr<const Block> block_ = testing::rough_block(GetParam());
    SplitVertices result_ = split_vertices(*block_);
    Diagonal diagonal_ = diagonal_of(GetParam());

    double height_m(Post post) const { return block_->data.height_m(post.row, post.column); }

    /// Greatest distance of a post in a triangle from its plane.
    double deviation_m(Code code) const {
        const Triangle triangle{corners(code, diagonal_, kBlockCells)};
        double greatest = 0.0;
        for (int i = 0; i < kBlockVertices; ++i) {
            const Post post{i / kBlockPosts, i % kBlockPosts};
            const glm::dvec3 weights = triangle.weights(post);
            if (std::min({weights.x, weights.y, weights.z}) < 0.0) continue;
            const double plane_m = weights.x * height_m(triangle.at.apex) +
                                   weights.y * height_m(triangle.at.left) +
                                   weights.z * height_m(triangle.at.right);
            greatest = std::max(greatest, std::abs(height_m(post) - plane_m));
        }
        return greatest;
    }
    const SplitVertex& vertex(Code code) const { return result_[block_triangles(diagonal_)[code].middle]; }
    double distance_m(int a, int b) const {
        const auto place = [&](int index) {
            const BlockVertex& vertex = block_->vertices[static_cast<std::size_t>(index)];
            return glm::dvec3{vertex.high[0], vertex.high[1], vertex.high[2]} +
                   glm::dvec3{vertex.low[0], vertex.low[1], vertex.low[2]};
        };
        return glm::distance(place(a), place(b));
    }
};

TEST_P(SplitVerticesOf, ErrorIsTheGreatestDeviationOfAnyPostFromTheTrianglesAndAllBelowThem) {
    // From the finest split up: the greatest of its two triangles and the four splits that stand on it.
    std::vector<double> expected(kBlockVertices, 0.0);
    for (Code code = kSplitCodesEnd - 1; code >= kRootA; --code) {
        const TriangleVertices& at = block_triangles(diagonal_)[code];
        double& error = expected[at.middle];
        error = std::max(error, deviation_m(code));
        if (level(code) + 1 == kFinestLevel) continue;
        for (const Code child : {left_child(code), right_child(code)})
            error = std::max(error, expected[block_triangles(diagonal_)[child].middle]);
    }
    for (Code code = kRootA; code < kSplitCodesEnd; ++code) {
        const auto at = block_triangles(diagonal_)[code].middle;
        const double error_m = double{result_[at].error.metres()};
        ASSERT_GE(error_m, expected[at] - 1e-3) << "code " << code;
        ASSERT_LE(error_m, expected[at] * (1.0 + 1.0 / 2048.0) + 0.01) << "code " << code;
    }
}

TEST_P(SplitVerticesOf, BallsHoldTheTriangleAndAreInsideTheParents) {
    for (Code code = kRootA; code < kSplitCodesEnd; ++code) {
        const TriangleVertices& at = block_triangles(diagonal_)[code];
        const double radius_m = double{vertex(code).radius.metres()};
        for (const auto corner : {at.apex, at.left, at.right})
            ASSERT_LE(distance_m(at.middle, corner), radius_m);
        if (level(code) == 0) continue;
        const int above = block_triangles(diagonal_)[parent(code)].middle;
        ASSERT_GE(vertex(parent(code)).error.metres(), vertex(code).error.metres());
        ASSERT_LE(distance_m(above, at.middle) + radius_m,
                  double{vertex(parent(code)).radius.metres()} * (1.0 + 1e-6));
    }
}

INSTANTIATE_TEST_SUITE_P(Tiles, SplitVerticesOf, ::testing::Values(TileId{9, 500, 300}, TileId{9, 501, 300}),
                         [](const auto& tile) {
                             return diagonal_of(tile.param) == Diagonal::Rising ? "Rising" : "Falling";
                         });

TEST(BintreeLengthBound, IsNeverTooSmallAndAtMostA2048thTooGreat) {
    EXPECT_EQ(LengthBound::of(0.0F).metres(), 0.0F);
    EXPECT_EQ(LengthBound::of(1e-5F).metres(), 1.0F / 128.0F) << "the least but 0";
    std::mt19937 random(5);
    std::uniform_real_distribution<float> octave(-6.9F, 23.9F);
    for (int i = 0; i < 100000; ++i) {
        const float length_m = std::exp2(octave(random));
        const float bound_m = LengthBound::of(length_m).metres();
        ASSERT_GE(bound_m, length_m);
        ASSERT_LE(double{bound_m}, double{length_m} * (1.0 + 1.0 / 2048.0));
        ASSERT_EQ(LengthBound::of(bound_m).metres(), bound_m) << "a bound is its own";
    }
}

TEST(BintreeArc, IsTheSagittaOfTheBase) {
    // A tile of depth 8 is 180/256 degrees; the base of its root is its diagonal.
    const double base_m = 6378137.0 * (180.0 / 256.0) * 3.14159265358979 / 180.0 * std::sqrt(2.0);
    EXPECT_NEAR(arc_height_m(8, 0), base_m * base_m / (8.0 * 6378137.0), 0.01);
    EXPECT_NEAR(arc_height_m(8, 2), arc_height_m(9, 0), 1e-6) << "a root of the child";
}

}  // namespace
}  // namespace eyepoint::terrain::bintree
