#include "terrain/database/virtual_tile.hpp"

#include <algorithm>

#include "terrain/database/interpolate.hpp"
#include "terrain/lod/error_level.hpp"

namespace eyepoint::terrain {

namespace {

/// The two parent posts, along one axis, between which a child's post lies; equal on an even post. Fine posts
/// count in the child's spacing from the parent's south-west corner, from -1.
struct Span {
    int low;
    int high;
};
constexpr Span span_of(int fine) { return {fine >> 1, (fine + 1) >> 1}; }

std::int32_t quanta_at(const BlockData& block, int row, int column, double height_step_m) {
    return to_quanta(block.height_m(row, column), height_step_m);
}

std::array<float, 4> corner_undulations(const std::array<float, 4>& parent, int quadrant) {
    const auto [sw, se, nw, ne] = parent;
    const float south = (sw + se) / 2.0F, north = (nw + ne) / 2.0F;
    const float west = (sw + nw) / 2.0F, east = (se + ne) / 2.0F;
    const float centre = (south + north) / 2.0F;
    switch (quadrant) {
        case 0:
            return {sw, south, west, centre};
        case 1:
            return {south, se, centre, east};
        case 2:
            return {west, centre, nw, north};
        default:
            return {centre, east, north, ne};
    }
}

}  // namespace

BlockData subdivide(const BlockData& parent, int quadrant, double height_step_m) {
    BlockData result;
    result.tile = child(parent.tile, quadrant);
    result.undulation_m = corner_undulations(parent.undulation_m, quadrant);
    const int south = (quadrant >> 1) * kBlockCells;
    const int west = (quadrant & 1) * kBlockCells;
    for (int row = -1; row <= kBlockPosts; ++row) {
        const Span rows = span_of(south + row);
        for (int column = -1; column <= kBlockPosts; ++column) {
            const Span columns = span_of(west + column);
            const auto post = midpoint(quanta_at(parent, rows.low, columns.low, height_step_m),
                                       quanta_at(parent, rows.high, columns.high, height_step_m));
            result.heights_m[static_cast<std::size_t>((row + 1) * kApronPosts + column + 1)] =
                to_metres(post, height_step_m);
        }
    }
    for (int row = 0; row < kBlockPosts; ++row) {
        const Span rows = span_of(south + row);
        for (int column = 0; column < kBlockPosts; ++column) {
            const Span columns = span_of(west + column);
            const auto low = static_cast<std::size_t>(rows.low * kBlockPosts + columns.low);
            const auto high = static_cast<std::size_t>(rows.high * kBlockPosts + columns.high);
            result.water[static_cast<std::size_t>(row * kBlockPosts + column)] =
                parent.water[low] & parent.water[high];
        }
    }
    return result;
}

NodeInfo subdivide(const NodeInfo& parent, TileId child) {
    NodeInfo result = parent;
    result.has_children = false;
    result.has_image = false;
    result.first_level = bare_level(child);
    result.last_level = parent.first_level;
    for (std::size_t level = kBlockLevels - 1; level > 0; --level)
        result.delta_m[level] = parent.delta_m[level - 1];
    result.delta_m[0] = parent.delta_m[0] / 4.0F;
    return result;
}

NestedMesh virtual_mesh(TileId tile, std::uint8_t last_level) {
    NestedMesh result;
    result.whole_grid = true;
    for (int row = 0; row < kBlockPosts; ++row) {
        // A border to the polar tiles goes as theirs does, which is sooner.
        const std::uint8_t border_level =
            tile.depth > 0 ? virtual_post_level(tile.depth, post_latitude_deg(tile, row)) : last_level;
        const std::uint8_t gone_level = std::min(border_level, last_level);
        for (int column = 0; column < kBlockPosts; ++column) {
            const bool stays = row % 2 == 0 && column % 2 == 0;
            const int target = row / 2 * 2 * kBlockPosts + column / 2 * 2;
            result.gone_level.push_back(stays ? NestedMesh::kStays : gone_level);
            result.target.push_back(static_cast<std::uint16_t>(stays ? 0 : target));
        }
    }
    return result;
}

}  // namespace eyepoint::terrain
