#include "terrain/lod/hyperblock/point_set.hpp"

#include <algorithm>

#include "terrain/lod/tile_cut.hpp"
#include "terrain/lod/triangle_arc.hpp"

namespace eyepoint::terrain::hyperblock {

using selective::DependencyHierarchy;
using selective::kNoRank;
using selective::kRanks;
using selective::Rank;

namespace {

/// Of what every second post would leave out. The greater, the fewer points and the more tiles.
constexpr double kToleranceShare = 0.4;

/// Up to this tolerance of a view, pixels, the horizon is kept as flat as terrain/lod/tile_cut.hpp says.
constexpr double kMostTauOfHorizonPx = 8.0;

}  // namespace

/// Finest level first: what a vertex stands on comes later.
void close_under_dependency(VertexSet& set) {
    const auto vertices = DependencyHierarchy::of_block().vertices();
    for (std::size_t rank = 0; rank < kRanks; ++rank) {
        if (!set[rank]) continue;
        for (const Rank parent : vertices[rank].parents)
            if (parent != kNoRank) set.set(parent);
    }
}

PointTolerance point_tolerance(TileId tile, const NodeInfo& info) {
    double every_second_m = 0.0, shrink = 1.0;
    for (std::size_t level = 1; level < info.delta_m.size(); ++level, shrink /= 4.0)
        every_second_m = std::max(every_second_m, shrink * info.delta_m[level]);
    const double surface_m = kToleranceShare * every_second_m,
                 cell_m = arc_height_m(tile.depth, selective::kLevels - 1);
    return {static_cast<float>(std::max(surface_m, cell_m)),
            static_cast<float>(std::max(kHorizonPx / kMostTauOfHorizonPx * surface_m, cell_m))};
}

PointSet point_set(const selective::BlockPosts& posts, float unseen_m, const PointTolerance& tolerance) {
    PointSet result;
    for (std::size_t rank = 0; rank < kRanks; ++rank) {
        result.vertices[rank] =
            posts.bound_m[rank] - unseen_m > tolerance.surface_m || posts.arc_m[rank] > tolerance.arc_m;
    }
    close_under_dependency(result.vertices);
    const auto vertices = DependencyHierarchy::of_block().vertices();
    for (std::size_t rank = 0; rank < kRanks; ++rank) {
        const auto& vertex = vertices[rank];
        if (vertex.edge == selective::kInside || !result.vertices[rank]) continue;
        for (int level = quad_level(vertex); level < kQuadLevels; ++level)
            result.border[static_cast<std::size_t>(level)][vertex.edge] |= vertex.border_bit;
    }
    return result;
}

}  // namespace eyepoint::terrain::hyperblock
