#include "terrain/lod/tile/tiled_block.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "terrain/lod/triangle_arc.hpp"
#include "terrain/lod/twist.hpp"

namespace eyepoint::terrain::tiles {

namespace {

struct Origin {
    int row = 0, column = 0;
};
Origin origin_of(const Division& division, int part) {
    return {part / division.parts * division.cells, part % division.parts * division.cells};
}

/// Of the posts in a cell of a level, from the cell's two triangles.
float cell_difference_m(const BlockData& data, Origin south_west, int step, bool rising) {
    const auto at = [&](int row, int column) {
        return data.height_m(south_west.row + row, south_west.column + column);
    };
    const float sw = at(0, 0), se = at(0, step), nw = at(step, 0), ne = at(step, step);
    float greatest = 0.0F;
    for (int row = 0; row <= step; ++row) {
        for (int column = 0; column <= step; ++column) {
            const float u = static_cast<float>(column) / static_cast<float>(step),
                        v = static_cast<float>(row) / static_cast<float>(step);
            const float east_m = (rising ? row <= column : row + column <= step) ? se - sw : ne - nw;
            const float north_m = (rising ? row <= column : row + column > step) ? ne - se : nw - sw;
            const bool from_north_east = !rising && row + column > step;
            const float drawn_m = from_north_east ? ne - (1.0F - u) * east_m - (1.0F - v) * north_m
                                                  : sw + u * east_m + v * north_m;
            greatest = std::max(greatest, std::abs(at(row, column) - drawn_m));
        }
    }
    return greatest;
}

float level_difference_m(const BlockData& data, const Division& division, Origin origin, int level) {
    const int step = 1 << level;
    float greatest = 0.0F;
    for (int row = 0; row < division.cells; row += step) {
        for (int column = 0; column < division.cells; column += step) {
            const bool rising = ((row + column) / step & 1) == 0;
            greatest = std::max(
                greatest, cell_difference_m(data, {origin.row + row, origin.column + column}, step, rising));
        }
    }
    return greatest;
}

/// Around a tile's posts and all that is below it.
TileBounds bounds_of(const TileNode& node, const Division& division, const Tile& tile) {
    if (division.parts == 1) return node.bounds;
    const Origin origin = origin_of(division, tile.part);
    float lowest_m = std::numeric_limits<float>::max(), highest_m = std::numeric_limits<float>::lowest();
    for (int row = 0; row <= division.cells; ++row) {
        for (int column = 0; column <= division.cells; ++column) {
            const float height_m = node.block->data.height_m(origin.row + row, origin.column + column);
            lowest_m = std::min(lowest_m, height_m);
            highest_m = std::max(highest_m, height_m);
        }
    }
    const float beyond_m = node.info.delta_m[0];
    return tile_bounds(tile.place, double{lowest_m - beyond_m}, double{highest_m + beyond_m});
}

}  // namespace

std::array<float, kMostLevels> level_errors_m(const BlockData& data, float unseen_m, const Division& division,
                                              int part) {
    const Origin origin = origin_of(division, part);
    std::array<float, kMostLevels> result{};
    for (int level = 0; level < division.levels; ++level) {
        const double arc_m = arc_height_m(data.tile.depth, 2 * (Tile::kBlockHalvings - level));
        result[static_cast<std::size_t>(level)] =
            unseen_m + static_cast<float>(arc_m) +
            (level == 0 ? 0.0F : level_difference_m(data, division, origin, level));
    }
    return result;
}

TiledBlock tiled(TileNode& node, const Division& division) {
    // Posts of a block without children are the surface itself, however cells are split between them.
    const float twist = node.info.has_children ? twist_m(node.block->data) : 0.0F;
    TiledBlock block{.node = &node, .excess_m = double{twist}, .tiles = {}};
    const auto deeper = static_cast<std::uint32_t>(std::countr_zero(static_cast<unsigned>(division.parts)));
    for (int part = 0; part < division.parts * division.parts; ++part) {
        Tile tile;
        tile.node = &node;
        tile.part = part;
        tile.place = {node.tile.depth + deeper,
                      (node.tile.x << deeper) + static_cast<std::uint32_t>(part % division.parts),
                      (node.tile.y << deeper) + static_cast<std::uint32_t>(part / division.parts)};
        tile.bounds = bounds_of(node, division, tile);
        tile.error_m = level_errors_m(node.block->data, node.info.delta_m[0] + twist, division, part);
        block.tiles.push_back(std::move(tile));
    }
    return block;
}

}  // namespace eyepoint::terrain::tiles
