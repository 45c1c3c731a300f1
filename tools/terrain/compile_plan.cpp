#include "tools/terrain/compile_plan.hpp"

#include <algorithm>
#include <vector>

namespace eyepoint::tools {

using terrain::TileId;

TilePlan::TilePlan(const ElevationSource& elevation, const ImagerySource* imagery,
                   const std::function<bool()>& cancelled) {
    std::vector<TileId> pending{{0, 0, 0}, {0, 1, 0}};
    while (!pending.empty() && !(cancelled && cancelled())) {
        const TileId tile = pending.back();
        pending.pop_back();
        max_depth_ = std::max(max_depth_, tile.depth);
        bool wanted = tile.depth == 0;
        for (int i = 0; i < 4 && !wanted && tile.depth < terrain::kMaxDepth; ++i) {
            const TileId below = child(tile, i);
            wanted = elevation.has_detail(below) || (imagery != nullptr && imagery->has_detail(below));
        }
        if (!wanted) continue;
        split_.insert(tile);
        for (int i = 0; i < 4; ++i) pending.push_back(child(tile, i));
    }
}

terrain::GeographicExtent TilePlan::deepest_extent() const {
    terrain::GeographicExtent bounds{180.0, 90.0, -180.0, -90.0};
    for (const TileId tile : split_) {
        if (tile.depth + 1 != max_depth_) continue;
        const auto side = extent(tile);
        bounds = {std::min(bounds.west_deg, side.west_deg), std::min(bounds.south_deg, side.south_deg),
                  std::max(bounds.east_deg, side.east_deg), std::max(bounds.north_deg, side.north_deg)};
    }
    return bounds;
}

}  // namespace eyepoint::tools
