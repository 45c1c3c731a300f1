/// Which children of a tile lie on which of its edges.
#pragma once

#include <array>
#include <cstddef>

#include "terrain/tiling/tile_id.hpp"

namespace eyepoint::terrain {

/// The two children of a tile that touch an edge, first the one nearer the edge's start (south or west).
[[nodiscard]] constexpr std::array<std::size_t, 2> children_at(Edge edge) {
    switch (edge) {
        case Edge::West:
            return {0, 2};
        case Edge::East:
            return {1, 3};
        case Edge::South:
            return {0, 1};
        case Edge::North:
            return {2, 3};
    }
    return {};
}

[[nodiscard]] constexpr Edge opposite(Edge edge) {
    switch (edge) {
        case Edge::West:
            return Edge::East;
        case Edge::East:
            return Edge::West;
        case Edge::South:
            return Edge::North;
        case Edge::North:
            return Edge::South;
    }
    return edge;
}

}  // namespace eyepoint::terrain
