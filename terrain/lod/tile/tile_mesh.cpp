#include "terrain/lod/tile/tile_mesh.hpp"

namespace eyepoint::terrain {

namespace {

constexpr int kHalfEdgeCells = kBlockCells / 2;

struct Post {
    int row = 0;
    int column = 0;
    bool operator==(const Post&) const = default;
};

bool has(std::uint8_t set, HalfEdge half) { return (set >> static_cast<int>(half)) & 1; }

/// Where a coordinate along a thinned edge goes: an odd multiple of the step moves to the post before it.
int snap(int along, int step, bool thinned) {
    return thinned && (along / step) % 2 == 1 ? along - step : along;
}

bool thinned_at(std::uint8_t set, HalfEdge first, HalfEdge second, int along) {
    return has(set, along < kHalfEdgeCells ? first : second);
}

Post moved(Post post, int step, std::uint8_t set) {
    using enum HalfEdge;
    const auto [row, column] = post;
    if (column == 0) post.row = snap(row, step, thinned_at(set, WestSouth, WestNorth, row));
    if (column == kBlockCells) post.row = snap(row, step, thinned_at(set, EastSouth, EastNorth, row));
    if (row == 0) post.column = snap(column, step, thinned_at(set, SouthWest, SouthEast, column));
    if (row == kBlockCells) post.column = snap(column, step, thinned_at(set, NorthWest, NorthEast, column));
    return post;
}

void append_triangle(std::vector<std::uint16_t>& indices, Post a, Post b, Post c) {
    if (a == b || b == c || a == c) return;
    for (const Post post : {a, b, c})
        indices.push_back(static_cast<std::uint16_t>(post.row * kBlockPosts + post.column));
}

/// Both triangles of every cell, counter-clockwise from above, split from the south-west to the north-east.
void append_mesh(std::vector<std::uint16_t>& indices, int level, std::uint8_t set) {
    const int step = 1 << level;
    for (int row = 0; row < kBlockCells; row += step) {
        for (int column = 0; column < kBlockCells; column += step) {
            const Post south_west = moved({row, column}, step, set);
            const Post south_east = moved({row, column + step}, step, set);
            const Post north_west = moved({row + step, column}, step, set);
            const Post north_east = moved({row + step, column + step}, step, set);
            append_triangle(indices, south_west, south_east, north_east);
            append_triangle(indices, south_west, north_east, north_west);
        }
    }
}

}  // namespace

TileMeshes::TileMeshes() {
    for (int level = 0; level < kTileLevels; ++level) {
        for (int set = 0; set < kHalfEdgeSets; ++set) {
            const auto first = static_cast<std::uint32_t>(indices_.size());
            append_mesh(indices_, level, static_cast<std::uint8_t>(set));
            ranges_[static_cast<std::size_t>(level * kHalfEdgeSets + set)] = {
                first, static_cast<std::uint32_t>(indices_.size()) - first};
        }
    }
}

}  // namespace eyepoint::terrain
