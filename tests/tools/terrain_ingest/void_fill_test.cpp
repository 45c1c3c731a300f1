// Filling voids.
#include "tools/terrain/void_fill.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/tools/terrain_ingest/raster_files.hpp"
#include "tools/terrain/mosaic_distance.hpp"
#include "tools/terrain/void_fill_relief.hpp"

namespace eyepoint::tools {
namespace {

constexpr double kSpacingDeg = 1.0 / 1200.0;

HeightGrid with_hole(int size, int radius, const std::function<double(int, int)>& height) {
    return testing::grid_of(size, size, 8.0, 47.0, kSpacingDeg, [&](int column, int row) {
        return std::hypot(column - size / 2, row - size / 2) <= radius ? std::nan("") : height(column, row);
    });
}

TEST(VoidFill, ContinuesAPlaneExactly) {
    const auto plane = [](int column, int row) { return 500.0 + 3.0 * column - 2.0 * row; };
    HeightGrid grid = with_hole(41, 8, plane);
    const VoidFill voids = fill_voids(grid, {});
    EXPECT_EQ(voids.outside, 0U);
    EXPECT_GT(voids.filled, 190U);
    for (int row = 0; row < 41; ++row) {
        for (int column = 0; column < 41; ++column) {
            // The tension pulls a little towards flat; a plane is flat in its own frame to a few centimetres.
            EXPECT_NEAR(grid.heights_m[grid.index(column, row)], plane(column, row), 0.1);
        }
    }
}

TEST(VoidFill, RaisesTheTopOfACone) {
    // A cone of 40 m a post, its top 600 m above the ground at 15 posts, cut off over 6 posts: a flat lid
    // would stay at the rim, 240 m too low. The tip of a cone is not in its rim; half of it and more must
    // come back.
    const auto cone = [](int column, int row) {
        return std::max(0.0, 600.0 - 40.0 * std::hypot(column - 25, row - 25));
    };
    HeightGrid grid = with_hole(51, 6, cone);
    const VoidFill voids = fill_voids(grid, {});
    EXPECT_EQ(voids.filled, 113U);
    const double rim = 600.0 - 40.0 * 6.0;
    EXPECT_GT(grid.heights_m[grid.index(25, 25)], rim + 80.0);
    EXPECT_LT(grid.heights_m[grid.index(25, 25)], 700.0);
}

TEST(VoidFill, TakesTheShapeOfTheCoarserSurface) {
    // The coarser surface has the peak, 100 m too low everywhere: filled, the peak stands at its true height.
    const auto peak = [](double column, double row) {
        return 1000.0 + 800.0 * std::exp(-(std::pow(column - 30.0, 2) + std::pow(row - 30.0, 2)) / 60.0);
    };
    HeightGrid grid = with_hole(61, 12, [&](int column, int row) { return peak(column, row); });
    const CoarserSurface coarser = [&](std::span<const GridPosition> posts) {
        std::vector<float> heights;
        for (const auto& post : posts)
            heights.push_back(static_cast<float>(peak(post.column, post.row) - 100.0));
        return heights;
    };
    const VoidFill voids = fill_voids(grid, coarser);
    EXPECT_GT(voids.filled, 400U);
    EXPECT_NEAR(grid.heights_m[grid.index(30, 30)], 1800.0, 60.0);
}

TEST(VoidFill, LeavesNoStepAtTheRim) {
    const auto hills = [](int column, int row) {
        return 800.0 + 120.0 * std::sin(column * 0.3) * std::cos(row * 0.25);
    };
    HeightGrid grid = with_hole(61, 10, hills);
    (void)fill_voids(grid, {});
    for (int row = 1; row < 61; ++row) {
        for (int column = 1; column < 61; ++column) {
            const float here = grid.heights_m[grid.index(column, row)];
            // Steepest true step is 36 m a post.
            EXPECT_LT(std::abs(here - grid.heights_m[grid.index(column - 1, row)]), 90.0F);
        }
    }
}

TEST(VoidFill, GivesTheSameFillTwice) {
    const auto hills = [](int column, int row) { return 800.0 + 90.0 * std::sin(column * 0.4 + row * 0.2); };
    HeightGrid once = with_hole(41, 9, hills);
    HeightGrid twice = once;
    (void)fill_voids(once, {});
    (void)fill_voids(twice, {});
    EXPECT_EQ(once.heights_m, twice.heights_m);
}

TEST(VoidFill, InsideTheSeaIsSea) {
    HeightGrid grid = with_hole(21, 4, [](int, int) { return 0.0; });
    (void)fill_voids(grid, {});
    for (const float height : grid.heights_m) EXPECT_EQ(height, 0.0F);
}

TEST(VoidFill, LeavesWideAreasToCoarserData) {
    HeightGrid grid = testing::grid_of(200, 20, 8.0, 47.0, kSpacingDeg,
                                       [](int column, int) { return column < 100 ? 50.0 : std::nan(""); });
    const VoidFill voids = fill_voids(grid, {});
    EXPECT_EQ(voids.filled, 0U);
    EXPECT_EQ(voids.outside, 2000U);
    EXPECT_TRUE(is_void(grid.heights_m[grid.index(150, 10)]));
}

TEST(VoidFill, NothingToDoIsNothingDone) {
    HeightGrid grid = testing::grid_of(5, 5, 8.0, 47.0, kSpacingDeg, [](int, int) { return 1.0; });
    EXPECT_EQ(fill_voids(grid, {}).filled, 0U);
}

TEST(RidgedRelief, HasUnitRoughness) {
    double sum = 0.0;
    for (int row = 0; row < 256; ++row) {
        for (int column = 0; column < 256; ++column) {
            const double bend = ridged_relief(column - 2, row) - 2.0 * ridged_relief(column, row) +
                                ridged_relief(column + 2, row);
            sum += bend * bend;
        }
    }
    EXPECT_NEAR(std::sqrt(sum / (256.0 * 256.0)), 1.0, 0.15);
}

TEST(DistanceToSites, AgreesWithBruteForce) {
    constexpr int kColumns = 23;
    constexpr int kRows = 17;
    std::vector<std::uint8_t> sites(kColumns * kRows, 0);
    for (std::size_t i = 0; i < sites.size(); ++i) sites[i] = (i * 2654435761U) % 41 == 3 ? 1 : 0;
    const auto distance = distance_to_sites(sites, kColumns, kRows);
    for (int row = 0; row < kRows; ++row) {
        for (int column = 0; column < kColumns; ++column) {
            double least = 1e9;
            for (int i = 0; i < kColumns * kRows; ++i) {
                if (sites[static_cast<std::size_t>(i)] == 0) continue;
                least = std::min(least, std::hypot(column - i % kColumns, row - i / kColumns));
            }
            EXPECT_NEAR(distance[static_cast<std::size_t>(row * kColumns + column)], least, 1e-5);
        }
    }
}

}  // namespace
}  // namespace eyepoint::tools
