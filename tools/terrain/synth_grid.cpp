#include "tools/terrain/synth_grid.hpp"

#include <algorithm>
#include <array>

#include <tbb/parallel_for.h>

namespace eyepoint::tools {

namespace {

/// Catmull-Rom weights of four posts for a place a share t of the way from the second to the third.
std::array<double, 4> cubic_weights(double t) {
    return {((-0.5 * t + 1.0) * t - 0.5) * t, (1.5 * t - 2.5) * t * t + 1.0, ((-1.5 * t + 2.0) * t + 0.5) * t,
            (0.5 * t - 0.5) * t * t};
}

double bilinear(const HeightGrid& grid, double column, double row) {
    const int c = std::clamp(static_cast<int>(column), 0, grid.side - 2);
    const int r = std::clamp(static_cast<int>(row), 0, grid.side - 2);
    const double u = column - c, v = row - r;
    const double* south = &grid.heights_m[static_cast<std::size_t>(r * grid.side + c)];
    const double* north = south + grid.side;
    return (south[0] * (1.0 - u) + south[1] * u) * (1.0 - v) + (north[0] * (1.0 - u) + north[1] * u) * v;
}

}  // namespace

glm::dvec2 place_of(const HeightGrid& grid, std::size_t post) {
    const auto side = static_cast<std::size_t>(grid.side);
    const double half_m = grid.spacing_m * (grid.side - 1) / 2.0;
    return {static_cast<double>(post % side) * grid.spacing_m - half_m,
            static_cast<double>(post / side) * grid.spacing_m - half_m};
}

glm::dvec2 column_row(const HeightGrid& grid, glm::dvec2 place_m) {
    const double half_m = grid.spacing_m * (grid.side - 1) / 2.0;
    const auto index = [&](double metres) {
        return std::clamp((metres + half_m) / grid.spacing_m, 0.0, grid.side - 1.0);
    };
    return {index(place_m.x), index(place_m.y)};
}

double height_m(const HeightGrid& grid, glm::dvec2 at) {
    const int c = static_cast<int>(at.x), r = static_cast<int>(at.y);
    if (c < 1 || r < 1 || c > grid.side - 3 || r > grid.side - 3) return bilinear(grid, at.x, at.y);
    const auto across = cubic_weights(at.x - c);
    const auto up = cubic_weights(at.y - r);
    double sum = 0.0;
    for (int j = 0; j < 4; ++j) {
        const double* post = &grid.heights_m[static_cast<std::size_t>((r + j - 1) * grid.side + c - 1)];
        sum += up[static_cast<std::size_t>(j)] *
               (across[0] * post[0] + across[1] * post[1] + across[2] * post[2] + across[3] * post[3]);
    }
    return sum;
}

glm::dvec2 gradient(const HeightGrid& grid, glm::dvec2 at) {
    return glm::dvec2{bilinear(grid, at.x + 1.0, at.y) - bilinear(grid, at.x - 1.0, at.y),
                      bilinear(grid, at.x, at.y + 1.0) - bilinear(grid, at.x, at.y - 1.0)} /
           (2.0 * grid.spacing_m);
}

HeightGrid smoothed(const HeightGrid& grid, double share) {
    HeightGrid result = grid;
    const auto side = static_cast<std::size_t>(grid.side);
    const std::vector<double>& before = grid.heights_m;
    tbb::parallel_for(std::size_t{1}, side - 1, [&](std::size_t row) {
        for (std::size_t at = row * side + 1; at + 1 < (row + 1) * side; ++at) {
            const double straight = before[at - 1] + before[at + 1] + before[at - side] + before[at + side];
            const double oblique =
                before[at - side - 1] + before[at - side + 1] + before[at + side - 1] + before[at + side + 1];
            result.heights_m[at] = (1.0 - share) * before[at] + share * (straight / 6.0 + oblique / 12.0);
        }
    });
    return result;
}

}  // namespace eyepoint::tools
