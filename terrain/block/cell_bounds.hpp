/// Between what heights a block's nested mesh is drawn, cell by cell: what it surely stays below, to be
/// hidden by nearer terrain, and what it surely stays above, to hide farther terrain
/// (terrain/lod/terrain_horizon.hpp).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include <glm/mat3x3.hpp>

#include "terrain/geodesy/position.hpp"

namespace eyepoint::terrain {

struct Block;

/// Bounds of all that a block may be drawn as: every vertex anywhere on its way from where it starts to where
/// it may have slid by the highest level asked for at any of them (nested_motion.hpp), in the block and in
/// its parent's. In a local frame: metres from `centre`, axes local_axes(centre).
///
/// - Tops: all triangles that a cell of the index lists has, at any level, lie over its rectangle and below
/// its
///   plane. Rectangles of neighbouring cells overlap, for triangles reach out of their cells.
/// - Low lines: nine lines along the parallels and nine along the meridians, straight between 9 x 9 nodes. No
/// part of
///   the drawn surface is below a line (where it is cut by the vertical plane through the line), whatever
///   cell it is of.
///
/// The farther vertices may slide, the looser it gets, so there is a step of bounds for each of the last
/// levels: step n holds while no level asked for is above level_limit(n) and the list drawn is of
/// list_level(n) or a coarser one. 9.0 kB.
struct CellBounds {
    static constexpr int kSide = 8;           ///< cells, kMeshCells
    static constexpr int kNodes = kSide + 1;  ///< a side
    static constexpr std::size_t kCells = std::size_t{kSide} * kSide;
    static constexpr std::size_t kLineNodes = std::size_t{kNodes} * kNodes;
    static constexpr int kSteps = 4;
    /// Levels above the block's last that the last step allows for: a block is drawn farther out than its
    /// last level asks for, as long as its parent's nearest point is too near for the parent.
    static constexpr int kLevelsBeyond = 2;

    Ecef centre{0.0};
    int last_limit = -1;          ///< of the last step; below 0: nothing is known of the block
    float radius_m = 0.0F;        ///< of a ball around the centre that holds everything drawn
    float height_range_m = 0.0F;  ///< along the local vertical

    /// A block is drawn with a list so many levels below the highest level asked for in it.
    static constexpr int kLevelsAList = 2;

    /// Nodes, from the south-west.
    std::array<float, kLineNodes> node_x{}, node_y{};
    /// Slopes of the tops' planes: of the cells, from the south-west, and of the whole block last.
    std::array<float, kCells + 1> slope_x{}, slope_y{};
    struct Step {
        /// Tops: rectangles, and the planes' heights at their south-west corners. An empty cell has west >
        /// east.
        std::array<float, kCells + 1> west{}, east{}, south{}, north{}, top{};
        /// Heights of a node as a point of the line along its row (parallel) and along its column (meridian).
        std::array<float, kLineNodes> row_low{}, column_low{};
    };
    std::array<Step, kSteps> steps{};

    [[nodiscard]] int level_limit(int step) const { return last_limit - (kSteps - 1 - step); }
    /// 0, the first list there is, for the first step.
    [[nodiscard]] int list_level(int step) const { return step == 0 ? 0 : level_limit(step) - kLevelsAList; }
};

/// Columns: unit vectors east, north and away from the Earth's centre, in ECEF. Undefined on the Earth's
/// axis.
[[nodiscard]] glm::dmat3 local_axes(const Ecef& centre);

/// `parent` is the parent's block, nullptr for a root. Nothing is known of tiles so large that
/// the difference between their edges and great circles counts, depths below 4. Up to 2 ms.
[[nodiscard]] CellBounds cell_bounds(const Block& block, const Block* parent);

}  // namespace eyepoint::terrain
