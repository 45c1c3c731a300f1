/// Between what heights a block's nested mesh is drawn, cell by cell: what it surely stays below, to be
/// hidden by nearer terrain, and what it surely stays above, to hide farther terrain
/// (terrain/lod/terrain_horizon.hpp).
#pragma once

#include <array>
#include <limits>

#include <glm/mat3x3.hpp>

#include "terrain/geodesy/position.hpp"

namespace eyepoint::terrain {

struct Block;

/// Bounds of all that a block may be drawn as while no vertex's level asked for is above `level_limit`: every
/// vertex anywhere on its way from where it starts to where it may have slid by then (nested_motion.hpp), in
/// the block and in its parent's. In a local frame: metres from `centre`, axes local_axes(centre).
///
/// - Tops: all triangles that a cell of the index lists has, at any level, lie over its rectangle and below
/// its
///   plane. Rectangles of neighbouring cells overlap, for triangles reach out of their cells.
/// - Low lines: nine lines along the parallels and nine along the meridians, straight between 9 x 9 nodes. No
/// part of
///   the drawn surface is below a line (where it is cut by the vertical plane through the line), whatever
///   cell it is of.
struct CellBounds {
    static constexpr int kSide = 8;           ///< cells, kMeshCells
    static constexpr int kNodes = kSide + 1;  ///< a side
    static constexpr int kCells = kSide * kSide;

    template <int N>
    using Floats = std::array<float, static_cast<std::size_t>(N)>;

    Ecef centre{0.0};
    /// -infinity: nothing is known of the block.
    float level_limit = -std::numeric_limits<float>::infinity();
    float radius_m = 0.0F;        ///< of a ball around the centre that holds everything drawn
    float height_range_m = 0.0F;  ///< along the local vertical

    /// Nodes, from the south-west; low heights of the node as a point of the line along its row (parallel)
    /// and along its column (meridian).
    Floats<kNodes * kNodes> node_x{}, node_y{}, row_low{}, column_low{};
    /// Tops of the cells, from the south-west, and of the whole block last. An empty cell has west > east.
    /// The plane's height at x, y: top + slope_x * (x - west) + slope_y * (y - south).
    Floats<kCells + 1> west{}, east{}, south{}, north{}, top{}, slope_x{}, slope_y{};
};

/// Columns: unit vectors east, north and away from the Earth's centre, in ECEF. Undefined on the Earth's
/// axis.
[[nodiscard]] glm::dmat3 local_axes(const Ecef& centre);

/// `parent` is the parent's block, nullptr for a root. Nothing is known (level_limit) of tiles so large that
/// the difference between their edges and great circles counts, depths below 4. About 0.1 ms.
[[nodiscard]] CellBounds cell_bounds(const Block& block, const Block* parent);

}  // namespace eyepoint::terrain
