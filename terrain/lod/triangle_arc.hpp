/// What right triangles over a tile's posts err by because the Earth is round.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "terrain/geodesy/earth.hpp"
#include "terrain/tiling/tile_id.hpp"

namespace eyepoint::terrain {

/// Height of the Earth's arc over the base of a triangle of a level, at the equator where it is greatest,
/// metres: what the triangle errs by on a bare Earth. Level 0 is half of a tile, each level halves a
/// triangle.
[[nodiscard]] inline double arc_height_m(std::uint32_t depth, int level) {
    constexpr double kPi = 3.14159265358979323846;
    const double base_rad = tile_side_deg(depth) * kPi / 180.0 * std::sqrt(2.0) * std::pow(0.5, level / 2.0);
    return kEquatorialRadiusM * (1.0 - std::cos(std::min(base_rad, kPi) / 2.0));
}

}  // namespace eyepoint::terrain
