/// Tests of all cells of a block at once: how far their boxes are, and on which side of a plane. Each
/// compiled for processors with and without AVX2; the results are the same to the bit. Thread use: pure
/// functions, from any thread.
#pragma once

#include <array>
#include <cstdint>

#include "terrain/block/cell_boxes.hpp"

namespace eyepoint::terrain {

/// Cells of a block: bit n is cell n.
using CellSet = std::uint64_t;

/// A point in the steps of a block's boxes, and what a step is worth.
struct StepPoint {
    std::array<float, 3> at{};             ///< steps
    std::array<float, 3> square_metres{};  ///< of a square step, by axis
};

/// The cells whose boxes are nowhere nearer to the point than a distance, given as its square, square metres.
[[nodiscard]] CellSet cells_beyond(const CellBoxes::Level& boxes, const StepPoint& point,
                                   float least_square_m2);

/// The cells whose boxes are nowhere farther.
[[nodiscard]] CellSet cells_within(const CellBoxes::Level& boxes, const StepPoint& point,
                                   float most_square_m2);

/// A plane as it runs through the steps of a block's boxes: value = first_m + slope_m . steps, metres.
struct StepPlane {
    float first_m = 0.0F;
    std::array<float, 3> slope_m{};
};

/// The cells whose boxes reach no value of the plane as high as this.
[[nodiscard]] CellSet cells_below(const CellBoxes::Level& boxes, const StepPlane& plane, float least_m);

}  // namespace eyepoint::terrain
