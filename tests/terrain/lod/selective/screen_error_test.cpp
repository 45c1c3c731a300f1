#include "terrain/lod/selective/screen_error.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "terrain/lod/twist.hpp"
#include "tests/terrain/lod/rough_block.hpp"

namespace eyepoint::terrain::selective {
namespace {

constexpr TileId kTile{12, 4283, 3072};

/// Weights of a triangle's corners at a post: barycentric, by areas.
glm::dvec3 weights(const TreeTriangle& triangle, int post) {
    const auto area = [](int a, int b, int c) {
        const auto row = [](int p) { return p / kBlockPosts; };
        const auto column = [](int p) { return p % kBlockPosts; };
        return static_cast<double>((column(b) - column(a)) * (row(c) - row(a)) -
                                   (column(c) - column(a)) * (row(b) - row(a)));
    };
    const auto [apex, left, right] = triangle.vertices;
    return glm::dvec3{area(post, left, right), area(apex, post, right), area(apex, left, post)} /
           area(apex, left, right);
}

class ScreenError : public ::testing::Test {
  protected:
    std::shared_ptr<const Block> block_ = testing::rough_block(kTile);
    static constexpr float kUnseenM = 3.0F;
    BlockPosts posts_ = block_posts(*block_, kUnseenM);

    [[nodiscard]] double height_m(int post) const {
        return block_->data.height_m(post / kBlockPosts, post % kBlockPosts);
    }
    template <typename See>
    void for_each_triangle(See see) const {
        const DependencyHierarchy& hierarchy = DependencyHierarchy::of_block();
        for (const TreeTriangle& root : hierarchy.roots()) see(root);
        for (const HierarchyVertex& vertex : hierarchy.vertices())
            for (std::size_t t = 0; t < vertex.triangle_count; ++t) see(vertex.triangles[t]);
    }
    /// From so far to the east and above the block's middle.
    [[nodiscard]] LodView view_from(double east_m, double above_m) const {
        const glm::dvec3 up = glm::normalize(posts_.origin),
                         east = glm::normalize(glm::dvec3{-posts_.origin.y, posts_.origin.x, 0.0});
        return {.eye = posts_.origin + east * east_m + up * above_m,
                .kappa_px = 1099.0,
                .tau_px = 2.0,
                .slack_px = 0.2};
    }
};

TEST_F(ScreenError, DeltaIsTheHeightDifferenceFromTheMiddleOfTheEdge) {
    for_each_triangle([&](const TreeTriangle& triangle) {
        if (triangle.middle == kNoRank) return;
        const double expected_m = height_m(middle_post(triangle)) -
                                  (height_m(triangle.vertices[1]) + height_m(triangle.vertices[2])) / 2.0;
        EXPECT_NEAR(posts_.delta_m[triangle.middle], std::abs(expected_m), 1e-3);
    });
}

TEST_F(ScreenError, BoundHoldsAtEveryPostOfTheTrianglesAndTheBallHoldsThem) {
    for_each_triangle([&](const TreeTriangle& triangle) {
        if (triangle.middle == kNoRank) return;
        const glm::dvec3 middle{posts_.x[triangle.middle], posts_.y[triangle.middle],
                                posts_.z[triangle.middle]};
        double greatest_m = 0.0;
        for (int post = 0; post < kBlockVertices; ++post) {
            const glm::dvec3 share = weights(triangle, post);
            if (std::min({share.x, share.y, share.z}) < 0.0) continue;
            const double plane_m = share.x * height_m(triangle.vertices[0]) +
                                   share.y * height_m(triangle.vertices[1]) +
                                   share.z * height_m(triangle.vertices[2]);
            greatest_m = std::max(greatest_m, std::abs(height_m(post) - plane_m));
            const glm::dvec3 at = block_->vertices[static_cast<std::size_t>(post)].position() - posts_.origin;
            EXPECT_LE(glm::distance(at, middle), posts_.radius_m[triangle.middle] + 0.01);
        }
        EXPECT_GE(posts_.bound_m[triangle.middle], greatest_m + kUnseenM);
    });
}

TEST_F(ScreenError, TwistIsHalfWhatACellIsBentBy) {
    BlockData flat;
    flat.tile = kTile;
    EXPECT_EQ(twist_m(flat), 0.0F);
    // A post at an odd row and an odd column ends both of its cells' diagonals as the hierarchy splits them.
    flat.heights_m[(4 + 1) * kApronPosts + 5 + 1] = 10.0F;
    EXPECT_EQ(twist_m(flat), 5.0F);
}

/// Section 5: a vertex fails where d lambda delta h / D^2 > tau.
TEST_F(ScreenError, PaperTestIsTheFormula) {
    for (const auto& [east_m, above_m] : {std::array{9000.0, 2500.0}, {40000.0, 9000.0}, {500.0, 30000.0}}) {
        const LodView view = view_from(east_m, above_m);
        TestedPosts tested;
        const BlockView from = block_view(view, posts_, 0.0);
        test_posts(ErrorFormula::Paper, posts_, from, tested);
        int failing = 0;
        for (Rank rank = 0; rank < kRanks; ++rank) {
            const glm::dvec3 to =
                posts_.origin + glm::dvec3{posts_.x[rank], posts_.y[rank], posts_.z[rank]} - view.eye;
            const glm::dvec3 up = glm::normalize(posts_.origin);
            const double distance_m = glm::length(to), horizontal_m = glm::length(to - up * glm::dot(to, up));
            const double expected_px =
                view.kappa_px * posts_.delta_m[rank] * horizontal_m / (distance_m * distance_m);
            // Nearly below the eye, h is what two floats leave.
            EXPECT_NEAR(error_px(ErrorFormula::Paper, posts_, rank, from), expected_px,
                        1e-3 * (1.0 + expected_px));
            if (std::abs(expected_px / view.tau_px - 1.0) < 1e-3) continue;
            EXPECT_EQ(tested.passes_by[rank]<0.0F, expected_px> view.tau_px) << rank;
            failing += expected_px > view.tau_px ? 1 : 0;
        }
        EXPECT_GT(failing, 0);
        EXPECT_LT(failing, static_cast<int>(kRanks));
    }
}

TEST_F(ScreenError, BoundTestFailsWhereTheBoundIsAboveTauAndStandsUntilTauAndSlack) {
    const LodView view = view_from(90000.0, 40000.0);
    const BlockView from = block_view(view, posts_, 1000.0);
    TestedPosts tested;
    test_posts(ErrorFormula::Bound, posts_, from, tested);
    int failing = 0;
    for (Rank rank = 0; rank < kRanks; ++rank) {
        const double px = error_px(ErrorFormula::Bound, posts_, rank, from);
        if (std::abs(px / view.tau_px - 1.0) < 1e-3) continue;
        const bool fails = px > view.tau_px;
        EXPECT_EQ(tested.passes_by[rank] < 0.0F, fails) << rank;
        failing += fails ? 1 : 0;
        if (fails) continue;
        // Straight towards the vertex, as far as it stands for.
        const glm::vec3 vertex{posts_.x[rank], posts_.y[rank], posts_.z[rank]};
        BlockView nearer = from;
        nearer.eye_m += glm::normalize(vertex - from.eye_m) * tested.stands_for_m[rank] * 0.999F;
        nearer.box_m = 0.0F;
        EXPECT_LE(error_px(ErrorFormula::Bound, posts_, rank, nearer),
                  (view.tau_px + view.slack_px) * 1.0001);
    }
    EXPECT_GT(failing, 0);
    EXPECT_LT(failing, static_cast<int>(kRanks));
}

TEST_F(ScreenError, WhatIsNearerThanAnythingDrawnNeverFails) {
    LodView view = view_from(0.0, 400.0);
    view.near_m = 1e9;
    TestedPosts tested;
    test_posts(ErrorFormula::Bound, posts_, block_view(view, posts_, 0.0), tested);
    EXPECT_EQ(std::count_if(tested.passes_by.begin(), tested.passes_by.end(),
                            [](float passes_by) { return passes_by < 0.0F; }),
              0);
}

TEST(AllowableHeightDifference, HasSoManyPixels) {
    EXPECT_DOUBLE_EQ(allowable_m(ErrorFormula::Bound, 1000.0, 2.0, 300.0, 500.0), 1.0);
    // tau D^2 / (d lambda h)
    EXPECT_DOUBLE_EQ(allowable_m(ErrorFormula::Paper, 1000.0, 2.0, 300.0, 500.0), 2.0 * 25e4 / 3e5);
    EXPECT_TRUE(std::isinf(allowable_m(ErrorFormula::Paper, 1000.0, 2.0, 0.0, 500.0)));
}

}  // namespace
}  // namespace eyepoint::terrain::selective
