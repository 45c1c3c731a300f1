/// The geometric error of coarse meshes against the full-resolution surface (NodeInfo::delta_m).
///
/// The surface S of a leaf: over each cell triangle (cells split from their south-west to their north-east
/// post), the point at a latitude and longitude has the height linear between the triangle's posts, on the
/// curved ellipsoid. The mesh of a resolution r is flat triangles, in space, over cells of 180 / 2^r degrees
/// with the same diagonals. The error at a place is the distance in space between both points of the same
/// latitude and longitude parameters: never less than the distance from the point of S to the mesh.
///
/// Leaf cells nest in coarse cells, and so do the triangles. Over one leaf triangle the mesh is affine; so
/// the distance from S to it is at most that at the triangle's posts plus the distance from S to the flat
/// triangle through the same posts (the sagitta). A coarse cell's error depends on r alone, whatever tile
/// draws it: level l of a tile at depth d has r = d + 5 - l.
///
/// Sagitta: the remainder of linear interpolation, half the second derivative of S, weighted. With cells of
/// side c radians, R >= every radius of curvature plus the height, the tangential parts of the graticule
/// included: |S''(a, b)| <= R (a^2 cos lat + 2 |a b| sin lat + b^2) + 2 |dh| |(a, b)|, which over a triangle
/// gives at most R c^2 / 8 * (1 + sqrt 5) + dh c / sqrt 8, dh the height range of the cell.
#pragma once

#include <array>
#include <vector>

#include "terrain/database/database.hpp"
#include "terrain/geodesy/position.hpp"

namespace eyepoint::tools {

/// Finest resolution there can be, plus one.
inline constexpr int kResolutions = terrain::kMaxDepth + terrain::kBlockLevels;

/// Heights at a tile's corners SW, SE, NW, NE, ellipsoidal metres.
struct TileCorners {
    terrain::TileId tile;
    std::array<float, 4> heights_m{};
};

/// What is known of the full-resolution surface below a tile, merged from its leaves.
struct SurfaceBounds {
    float height_min_m = 0.0F;
    float height_max_m = 0.0F;
    /// An upper bound on the error of each resolution, metres.
    std::array<double, kResolutions> error_m{};

    void merge(const SurfaceBounds& other);
};

/// Bound on the distance of a leaf's surface from the flat triangles of its own posts, metres.
[[nodiscard]] double sagitta_m(const terrain::BlockData& leaf);

/// ancestors: every tile above the leaf, in any order.
[[nodiscard]] SurfaceBounds leaf_bounds(const terrain::BlockData& leaf,
                                        const std::vector<TileCorners>& ancestors);

/// What a tile's node says of the surface below it: heights and delta_m, rounded outwards.
[[nodiscard]] terrain::NodeInfo node_info(terrain::TileId tile, const SurfaceBounds& below);

}  // namespace eyepoint::tools
