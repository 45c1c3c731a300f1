#include "terrain/database/whole_grid.hpp"

#include <array>
#include <cstddef>

#include "terrain/tiling/tile_id.hpp"

namespace eyepoint::terrain {

namespace {

constexpr std::size_t kIndices = std::size_t{kBlockCells} * kBlockCells * 6;

constexpr std::array<std::uint16_t, kIndices> triangles() {
    std::array<std::uint16_t, kIndices> all{};
    std::size_t next = 0;
    const auto add = [&](int a, int b, int c) {
        for (const int post : {a, b, c}) all[next++] = static_cast<std::uint16_t>(post);
    };
    for (int row = 0; row < kBlockCells; ++row) {
        for (int column = 0; column < kBlockCells; ++column) {
            const int sw = row * kBlockPosts + column, se = sw + 1, nw = sw + kBlockPosts, ne = nw + 1;
            const bool south_east = row == 0 && column == kBlockCells - 1;
            const bool north_west = row == kBlockCells - 1 && column == 0;
            if (south_east || north_west) {
                add(sw, se, nw);
                add(se, ne, nw);
            } else {
                add(sw, se, ne);
                add(sw, ne, nw);
            }
        }
    }
    return all;
}

constexpr auto kTriangles = triangles();

}  // namespace

std::span<const std::uint16_t> whole_grid_triangles() { return kTriangles; }

}  // namespace eyepoint::terrain
