#include "terrain/lod/cell_tests.hpp"

#include <algorithm>
#include <cstddef>
#include <random>

#include <gtest/gtest.h>

namespace eyepoint::terrain {
namespace {

/// Boxes of any size and place, also flat ones.
CellBoxes::Level random_boxes(std::mt19937& random) {
    std::uniform_int_distribution<int> steps(0, 255);
    CellBoxes::Level boxes;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        for (std::size_t cell = 0; cell < CellBoxes::kCells; ++cell) {
            const int a = steps(random), b = steps(random);
            boxes.low[axis][cell] = static_cast<std::uint8_t>(std::min(a, b));
            boxes.high[axis][cell] = static_cast<std::uint8_t>(std::max(a, b));
        }
    }
    return boxes;
}

/// Squares of the distances of a point from the nearest and the farthest corner or side of a box.
struct Squares {
    double nearest_m2 = 0.0, farthest_m2 = 0.0;
};
Squares squares(const CellBoxes::Level& boxes, std::size_t cell, const StepPoint& point) {
    Squares result;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double low = boxes.low[axis][cell], high = boxes.high[axis][cell], at = point.at[axis];
        const double near = at - std::clamp(at, low, high), far = std::max(at - low, high - at);
        result.nearest_m2 += near * near * double{point.square_metres[axis]};
        result.farthest_m2 += far * far * double{point.square_metres[axis]};
    }
    return result;
}

bool holds(CellSet cells, std::size_t cell) { return (cells >> cell & 1U) != 0; }

TEST(CellTests, AgreeWithEachBoxAloneButForRounding) {
    std::mt19937 random(4);
    std::uniform_real_distribution<float> place(-100.0F, 355.0F), weight(0.01F, 100.0F), slope(-3.0F, 3.0F);
    for (int round = 0; round < 200; ++round) {
        const CellBoxes::Level boxes = random_boxes(random);
        const StepPoint point{{place(random), place(random), place(random)},
                              {weight(random), weight(random), weight(random)}};
        const StepPlane plane{place(random), {slope(random), slope(random), slope(random)}};
        const auto some = static_cast<std::size_t>(round) % CellBoxes::kCells;
        const auto near_m2 = static_cast<float>(squares(boxes, some, point).nearest_m2);
        const auto far_m2 = static_cast<float>(squares(boxes, some, point).farthest_m2);
        const CellSet beyond = cells_beyond(boxes, point, near_m2),
                      within = cells_within(boxes, point, far_m2);
        const CellSet below = cells_below(boxes, plane, 50.0F);
        for (std::size_t cell = 0; cell < CellBoxes::kCells; ++cell) {
            const Squares of = squares(boxes, cell, point);
            if (std::abs(of.nearest_m2 - double{near_m2}) > 1e-5 * of.farthest_m2) {
                EXPECT_EQ(holds(beyond, cell), of.nearest_m2 > double{near_m2});
            }
            if (std::abs(of.farthest_m2 - double{far_m2}) > 1e-5 * of.farthest_m2) {
                EXPECT_EQ(holds(within, cell), of.farthest_m2 < double{far_m2});
            }
            double highest_m = plane.first_m;
            for (std::size_t axis = 0; axis < 3; ++axis)
                highest_m += std::max(double{plane.slope_m[axis]} * boxes.low[axis][cell],
                                      double{plane.slope_m[axis]} * boxes.high[axis][cell]);
            if (std::abs(highest_m - 50.0) > 1e-2) {
                EXPECT_EQ(holds(below, cell), highest_m < 50.0);
            }
        }
    }
}

}  // namespace
}  // namespace eyepoint::terrain
