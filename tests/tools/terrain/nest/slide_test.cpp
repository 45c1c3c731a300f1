#include "tools/terrain/nest/slide.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "terrain/tiling/tile_id.hpp"

namespace eyepoint::tools {
namespace {

constexpr int kSide = 17;

double twice_area(const Corner& a, const Corner& b, const Corner& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

Corner part_way(const Corner& from, const Corner& to, double share) {
    Corner corner{from.x + share * (to.x - from.x), from.y + share * (to.y - from.y), {}};
    corner.position_m[0] =
        static_cast<float>(from.position_m[0] + share * (to.position_m[0] - from.position_m[0]));
    return corner;
}

SlideTolerance same_all_the_way(float tolerance_m) {
    SlideTolerance tolerance;
    tolerance.begin_m = tolerance_m;
    tolerance.quarters_m.fill(tolerance_m);
    tolerance.between_m.fill(tolerance_m);
    return tolerance;
}

/// Rough ground, and triangles between its samples of which one corner or more slide to other samples.
class SlidingOverRoughGround : public ::testing::Test {
  protected:
    SlidingOverRoughGround() {
        samples_.side = kSide;
        std::uniform_real_distribution<float> height_m(0.0F, 30.0F);
        for (int i = 0; i < kSide * kSide; ++i) samples_.heights_m.push_back(height_m(random_));
        samples_.between_m.assign(samples_.heights_m.size(), 0.0F);
        lay_out();
    }

    void lay_out() {
        surface_.emplace(kTile, samples_);
        const auto sides = terrain::extent(kTile);
        const double spacing_deg = terrain::tile_side_deg(kTile.depth) / (kSide - 1);
        corners_.clear();
        for (int row = 0; row < kSide; ++row) {
            for (int column = 0; column < kSide; ++column) {
                corners_.push_back({static_cast<double>(column), static_cast<double>(row),
                                    surface_->position_m(sides.south_deg + row * spacing_deg,
                                                         sides.west_deg + column * spacing_deg,
                                                         samples_.heights_m[samples_.at(row, column)])});
            }
        }
    }

    const Corner& sample(int column, int row) { return corners_[samples_.at(row, column)]; }

    Corner any_sample() {
        std::uniform_int_distribution<int> place(0, kSide - 1);
        const int column = place(random_);
        return sample(column, place(random_));
    }

    SlidingTriangle any_triangle(std::size_t sliding) {
        while (true) {
            SlidingTriangle triangle;
            for (Corner& corner : triangle.from) corner = any_sample();
            if (twice_area(triangle.from[0], triangle.from[1], triangle.from[2]) <= 0.0) continue;
            triangle.to = triangle.from;
            for (std::size_t i = 0; i < sliding; ++i) triangle.to[i] = any_sample();
            if (twice_area(triangle.to[0], triangle.to[1], triangle.to[2]) >= 0.0) return triangle;
        }
    }

    /// Of all samples in the triangle, by barycentric coordinates.
    double error_m(const Corner& a, const Corner& b, const Corner& c) {
        const double area = twice_area(a, b, c);
        double greatest_m = 0.0;
        for (const Corner& at : corners_) {
            const double of_a = twice_area(at, b, c) / area, of_b = twice_area(a, at, c) / area,
                         of_c = twice_area(a, b, at) / area;
            if (std::min({of_a, of_b, of_c}) < 0.0) continue;
            const double height_m = of_a * a.position_m[0] + of_b * b.position_m[0] + of_c * c.position_m[0];
            greatest_m = std::max(greatest_m, std::abs(height_m - at.position_m[0]));
        }
        return greatest_m;
    }

    /// 0 of a line.
    double whole_error_m(const Corner& a, const Corner& b, const Corner& c) {
        if (std::abs(twice_area(a, b, c)) < 1e-6) return 0.0;
        return error_m(a, b, c);
    }

    static constexpr terrain::TileId kTile{13, 2700, 6200};
    std::mt19937 random_{7};
    HeightSamples samples_;
    std::optional<SampledSurface> surface_;
    std::vector<Corner> corners_;  ///< of all samples
};

TEST_F(SlidingOverRoughGround, WhatSlidesWellHasNoGreaterErrorAtAnyShareOfItsSlide) {
    constexpr float kToleranceM = 22.0F;
    int good = 0;
    for (int round = 0; round < 2000; ++round) {
        const SlidingTriangle triangle = any_triangle(1);
        const auto& [a, b, c] = triangle.from;
        const Corner& to = triangle.to[0];
        // Where it begins and ends is not the slide's affair, and the side from c is the neighbour's.
        if (std::max({whole_error_m(a, b, c), whole_error_m(to, b, c), whole_error_m(a, to, c)}) >
            kToleranceM)
            continue;
        if (!slides_well(triangle, *surface_, same_all_the_way(kToleranceM))) continue;
        ++good;
        for (int step = 1; step < 60; ++step)
            ASSERT_LE(whole_error_m(part_way(a, to, step / 60.0), b, c), kToleranceM + 0.01) << step;
    }
    EXPECT_GT(good, 100);
}

TEST_F(SlidingOverRoughGround, NothingIsRefusedThatStaysWithinTheToleranceAndUnfolded) {
    int good = 0;
    for (int round = 0; round < 3000; ++round) {
        const SlidingTriangle triangle = any_triangle(1);
        const auto& [a, b, c] = triangle.from;
        const Corner& to = triangle.to[0];
        double greatest_m = whole_error_m(a, to, b);
        for (const double share : {0.25, 0.5, 0.75})
            greatest_m = std::max(greatest_m, whole_error_m(part_way(a, to, share), b, c));
        ASSERT_TRUE(
            slides_well(triangle, *surface_, same_all_the_way(static_cast<float>(greatest_m) + 0.01F)));
        good += greatest_m < 25.0 ? 1 : 0;
    }
    EXPECT_GT(good, 100);
}

TEST_F(SlidingOverRoughGround, WhatSlidesWellFoldsForNoSharesThatAreNearEachOther) {
    std::uniform_real_distribution<double> share(0.0, 1.0), apart(0.0, kSharesApart);
    int good = 0, folding = 0;
    for (int round = 0; round < 3000; ++round) {
        const SlidingTriangle triangle = any_triangle(3);
        bool folds = false;
        for (int shares = 0; shares < 200; ++shares) {
            const double least = share(random_);
            std::array<Corner, 3> moved;
            for (std::size_t i = 0; i < 3; ++i)
                moved[i] = part_way(triangle.from[i], triangle.to[i], std::min(least + apart(random_), 1.0));
            folds = folds || twice_area(moved[0], moved[1], moved[2]) < -1e-6;
        }
        const bool well = slides_well(triangle, *surface_, same_all_the_way(1e6F));
        ASSERT_FALSE(well && folds);
        good += well ? 1 : 0;
        folding += folds ? 1 : 0;
    }
    EXPECT_GT(good, 100);
    EXPECT_GT(folding, 100);
}

TEST_F(SlidingOverRoughGround, NoTriangleOnTheWayHasAGreaterErrorThanTheSweepsBound) {
    std::uniform_real_distribution<double> share(0.0, 1.0);
    double least_m = 1e9;
    for (int round = 0; round < 2000; ++round) {
        const SlidingTriangle triangle = any_triangle(3);
        const float bound_m = surface_->sweep_bound_m(triangle.from, triangle.to);
        least_m = std::min(least_m, double{bound_m});
        for (int shares = 0; shares < 20; ++shares) {
            std::array<Corner, 3> moved;
            for (std::size_t i = 0; i < 3; ++i)
                moved[i] = part_way(triangle.from[i], triangle.to[i], share(random_));
            ASSERT_LE(whole_error_m(moved[0], moved[1], moved[2]), bound_m + 0.01F);
        }
    }
    EXPECT_LT(least_m, 60.0);  // of ground 30 m high
}

TEST_F(SlidingOverRoughGround, PostsBesideTheGridAreInTheSweepsBound) {
    const SlidingTriangle triangle{{sample(4, 4), sample(6, 4), sample(4, 6)},
                                   {sample(4, 4), sample(6, 4), sample(6, 6)}};
    const float without_m = surface_->sweep_bound_m(triangle.from, triangle.to);
    samples_.between_m.assign(samples_.between_m.size(), 7.0F);
    lay_out();
    EXPECT_FLOAT_EQ(surface_->sweep_bound_m(triangle.from, triangle.to), without_m + 7.0F);
    samples_.lone.push_back({5.5, 4.5, 500.0F});
    lay_out();
    EXPECT_GT(surface_->sweep_bound_m(triangle.from, triangle.to), 400.0F);
}

/// The case of the benchmark field that quarters alone did not see.
TEST_F(SlidingOverRoughGround, ASpikeBetweenTwoQuartersIsSeen) {
    std::fill(samples_.heights_m.begin(), samples_.heights_m.end(), 0.0F);
    samples_.heights_m[samples_.at(8, 8)] = 100.0F;
    lay_out();
    // The side from (1, 1) to the sliding corner passes (8, 8) three tenths of the way.
    const SlidingTriangle triangle{{sample(11, 8), sample(16, 16), sample(1, 1)},
                                   {sample(1, 8), sample(16, 16), sample(1, 1)}};
    EXPECT_FALSE(slides_well(triangle, *surface_, same_all_the_way(50.0F)));
}

}  // namespace
}  // namespace eyepoint::tools
