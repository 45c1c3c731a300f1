/// A square grid of heights and how to read it between its posts.
/// Thread use: pure functions, from any thread.
#pragma once

#include <cstddef>
#include <vector>

#include <glm/vec2.hpp>

namespace eyepoint::tools {

/// A square grid, rows from south, columns from west.
struct HeightGrid {
    int side = 0;  ///< posts a side
    double spacing_m = 0.0;
    std::vector<double> heights_m;
};

/// Metres east and north of the grid's centre.
[[nodiscard]] glm::dvec2 place_of(const HeightGrid& grid, std::size_t post);

/// Column and row, in spacings from the south-west post, of a place; clamped to the grid.
[[nodiscard]] glm::dvec2 column_row(const HeightGrid& grid, glm::dvec2 place_m);

/// Smooth (Catmull-Rom) through the posts; linear next to the border.
[[nodiscard]] double height_m(const HeightGrid& grid, glm::dvec2 at_column_row);

/// Rise over run towards east and north, over one spacing to either side; continuous.
[[nodiscard]] glm::dvec2 gradient(const HeightGrid& grid, glm::dvec2 at_column_row);

/// Creep: ground evens out a little, so that slopes are not the straight lines of the grid's eight
/// directions. share: 0 leaves each post as it is, 1 replaces it by the mean of its neighbours.
[[nodiscard]] HeightGrid smoothed(const HeightGrid& grid, double share);

}  // namespace eyepoint::tools
