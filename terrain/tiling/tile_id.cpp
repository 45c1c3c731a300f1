#include "terrain/tiling/tile_id.hpp"

#include <algorithm>
#include <cmath>

namespace eyepoint::terrain {

TileId tile_at(double latitude_deg, double longitude_deg, std::uint32_t depth) {
    const double side = tile_side_deg(depth);
    const double turns = (longitude_deg + 180.0) / 360.0;
    const double east_deg = (turns - std::floor(turns)) * 360.0;
    const double north_deg = std::clamp(latitude_deg, -90.0, 90.0) + 90.0;
    const auto last_x = static_cast<double>(tiles_across(depth) - 1);
    const auto last_y = static_cast<double>(tiles_up(depth) - 1);
    return {depth, static_cast<std::uint32_t>(std::min(std::floor(east_deg / side), last_x)),
            static_cast<std::uint32_t>(std::min(std::floor(north_deg / side), last_y))};
}

}  // namespace eyepoint::terrain
