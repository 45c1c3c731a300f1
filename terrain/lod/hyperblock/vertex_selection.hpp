/// Selection of single vertices, from the coarsest down: QuadTIN, which HyperBlock is compared with. Source:
/// HyperBlock-QuadTIN, section 3.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "terrain/lod/hyperblock/eye_in_tile.hpp"
#include "terrain/lod/hyperblock/point_set.hpp"
#include "terrain/lod/selective/block_posts.hpp"

namespace eyepoint::terrain::hyperblock {

/// Of a tile's points, by rank. Nested: the sphere holds those of all points that depend on this one, and
/// none of them has a greater error or arc. So if a point is selected, so are the two it depends on, wherever
/// the eye is, and selection needs no second look at neighbours.
struct NestedPoint {
    Sphere bounds;
    float error_m =
        0.0F;  ///< of the two triangles that are drawn without it (selective::BlockPosts::bound_m)
    float arc_m = 0.0F;
};
using NestedPoints = std::array<NestedPoint, selective::kRanks>;
[[nodiscard]] NestedPoints nested_points(const selective::BlockPosts& posts, const PointSet& points);

/// Appends the triangles of the points that are in the view volume and whose error is above the tolerance.
/// Returns the selected ones on the tile's edges.
[[nodiscard]] selective::BorderSelection select_vertices(const PointSet& points, const NestedPoints& nested,
                                                         const EyeInTile& eye, const ScreenScale& scale,
                                                         std::vector<std::uint16_t>& indices);

}  // namespace eyepoint::terrain::hyperblock
