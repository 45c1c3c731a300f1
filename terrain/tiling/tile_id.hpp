/// The geographic tiling (EPSG:4326): a quadtree on latitude and longitude over the whole Earth.
/// Depth d has 2^(d+1) x 2^d tiles of 180/2^d degrees; x counts east from 180 W, y counts north from 90 S.
/// A tile's block is grid-registered: 33 x 33 posts, the outer ones on the tile's edges, so a coarse post is
/// a fine post. All post positions are dyadic fractions of a turn and exact in double.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>

namespace eyepoint::terrain {

inline constexpr int kBlockCells = 32;
inline constexpr int kBlockPosts = kBlockCells + 1;
/// Deepest tile: posts 0.6 mm apart in latitude. Keeps every tile number within 26 bits.
inline constexpr int kMaxDepth = 25;

struct TileId {
    std::uint32_t depth = 0;
    std::uint32_t x = 0;
    std::uint32_t y = 0;

    auto operator<=>(const TileId&) const = default;
};

/// The four children of a tile, in the order south-west, south-east, north-west, north-east.
[[nodiscard]] constexpr TileId child(TileId tile, int quadrant) {
    return {tile.depth + 1, tile.x * 2 + static_cast<std::uint32_t>(quadrant & 1),
            tile.y * 2 + static_cast<std::uint32_t>(quadrant >> 1)};
}
[[nodiscard]] constexpr TileId parent(TileId tile) { return {tile.depth - 1, tile.x / 2, tile.y / 2}; }
/// Which child of its parent a tile is, 0..3.
[[nodiscard]] constexpr int quadrant(TileId tile) {
    return static_cast<int>((tile.x & 1U) | ((tile.y & 1U) << 1));
}
[[nodiscard]] constexpr TileId ancestor(TileId tile, std::uint32_t depth) {
    return {depth, tile.x >> (tile.depth - depth), tile.y >> (tile.depth - depth)};
}

[[nodiscard]] constexpr std::uint32_t tiles_across(std::uint32_t depth) { return 2U << depth; }
[[nodiscard]] constexpr std::uint32_t tiles_up(std::uint32_t depth) { return 1U << depth; }
[[nodiscard]] constexpr bool is_valid(TileId tile) {
    return tile.depth <= kMaxDepth && tile.x < tiles_across(tile.depth) && tile.y < tiles_up(tile.depth);
}

enum class Edge : std::uint8_t { West, East, South, North };
inline constexpr std::array<Edge, 4> kEdges{Edge::West, Edge::East, Edge::South, Edge::North};

/// The tile of the same depth across an edge; wraps over the antimeridian, none beyond a pole.
[[nodiscard]] constexpr std::optional<TileId> neighbour(TileId tile, Edge edge) {
    const std::uint32_t across = tiles_across(tile.depth);
    switch (edge) {
        case Edge::West:
            return TileId{tile.depth, (tile.x + across - 1) % across, tile.y};
        case Edge::East:
            return TileId{tile.depth, (tile.x + 1) % across, tile.y};
        case Edge::South:
            return tile.y == 0 ? std::nullopt : std::optional{TileId{tile.depth, tile.x, tile.y - 1}};
        case Edge::North:
            return tile.y + 1 == tiles_up(tile.depth) ? std::nullopt
                                                      : std::optional{TileId{tile.depth, tile.x, tile.y + 1}};
    }
    return std::nullopt;
}

/// Side of a tile, degrees.
[[nodiscard]] constexpr double tile_side_deg(std::uint32_t depth) {
    return 180.0 / static_cast<double>(std::uint64_t{1} << depth);
}
/// Spacing of a tile's posts, degrees.
[[nodiscard]] constexpr double post_spacing_deg(std::uint32_t depth) {
    return tile_side_deg(depth) / kBlockCells;
}

/// Latitude of a post row, degrees; row 0 is the south edge, 32 the north edge; exact. Rows outside 0..32 lie
/// in the neighbouring tiles (and beyond a pole, past 90 degrees).
[[nodiscard]] constexpr double post_latitude_deg(TileId tile, int row) {
    return static_cast<double>(std::int64_t{tile.y} * kBlockCells + row) * post_spacing_deg(tile.depth) -
           90.0;
}
/// Longitude of a post column, degrees; column 0 is the west edge, 32 the east edge; exact. The antimeridian
/// is -180 from both sides, so that both sides get the same vertex.
[[nodiscard]] constexpr double post_longitude_deg(TileId tile, int column) {
    const std::int64_t posts_around = std::int64_t{tiles_across(tile.depth)} * kBlockCells;
    const std::int64_t post = (std::int64_t{tile.x} * kBlockCells + column + posts_around) % posts_around;
    return static_cast<double>(post) * post_spacing_deg(tile.depth) - 180.0;
}

/// The edges of a tile in degrees. East is -180 + (x+1) side, so up to +180, never wrapped: east > west.
struct GeographicExtent {
    double west_deg = 0.0;
    double south_deg = 0.0;
    double east_deg = 0.0;
    double north_deg = 0.0;
};
[[nodiscard]] constexpr GeographicExtent extent(TileId tile) {
    const double side = tile_side_deg(tile.depth);
    return {tile.x * side - 180.0, tile.y * side - 90.0, (tile.x + 1.0) * side - 180.0,
            (tile.y + 1.0) * side - 90.0};
}

/// The tile of a depth that holds a place; on shared edges the eastern and northern one. Latitude is clamped
/// to -90..90, longitude may be any turn.
[[nodiscard]] TileId tile_at(double latitude_deg, double longitude_deg, std::uint32_t depth);

/// A unique number for a tile, for hashing and for files: depth and the path from the root.
[[nodiscard]] constexpr std::uint64_t key(TileId tile) {
    return (std::uint64_t{tile.depth} << 56) | (std::uint64_t{tile.y} << 28) | tile.x;
}

struct TileHash {
    std::size_t operator()(TileId tile) const noexcept {
        std::uint64_t bits = key(tile) * 0x9e3779b97f4a7c15ULL;
        return static_cast<std::size_t>(bits ^ (bits >> 29));
    }
};

}  // namespace eyepoint::terrain
