#include "terrain/surface/surface_height.hpp"

#include <algorithm>
#include <cmath>

namespace eyepoint::terrain {

namespace {

TileId deepest_tile(const Database& database, double latitude_deg, double longitude_deg) {
    TileId tile = tile_at(latitude_deg, longitude_deg, 0);
    for (const NodeInfo* info = database.find(tile); info != nullptr && info->has_children;
         info = database.find(tile)) {
        tile = tile_at(latitude_deg, longitude_deg, tile.depth + 1);
    }
    return tile;
}

/// Height within a block; row and column in posts, fractions between them.
double interpolate(const BlockData& block, double row, double column) {
    const int south = std::clamp(static_cast<int>(row), 0, kBlockCells - 1);
    const int west = std::clamp(static_cast<int>(column), 0, kBlockCells - 1);
    const double up = row - south, right = column - west;
    const double south_west = block.height_m(south, west), north_east = block.height_m(south + 1, west + 1);
    if (right >= up) {
        const double south_east = block.height_m(south, west + 1);
        return south_west + (south_east - south_west) * right + (north_east - south_east) * up;
    }
    const double north_west = block.height_m(south + 1, west);
    return south_west + (north_west - south_west) * up + (north_east - north_west) * right;
}

}  // namespace

std::optional<EllipsoidalHeight> SurfaceHeight::at(double latitude_deg, double longitude_deg) {
    const TileId tile = deepest_tile(*database_, latitude_deg, longitude_deg);
    if (!last_ || last_->tile != tile) {
        auto block = database_->read_block(tile);
        if (!block) return std::nullopt;
        last_ = *std::move(block);
    }
    const GeographicExtent area = extent(tile);
    const double spacing_deg = post_spacing_deg(tile.depth);
    const double east_deg =
        longitude_deg - 360.0 * std::floor((longitude_deg - area.west_deg) / 360.0) - area.west_deg;
    return EllipsoidalHeight{
        interpolate(*last_, (latitude_deg - area.south_deg) / spacing_deg, east_deg / spacing_deg)};
}

}  // namespace eyepoint::terrain
