/// Where the triangles of a nested mesh are, cell by cell, for choosing their levels and leaving out what is
/// beside the view (terrain/lod/cell_cut.hpp).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "terrain/geodesy/position.hpp"

namespace eyepoint::terrain {

struct Block;

/// Boxes of cells (NestedLevel), in a local frame of the block. The box of a cell for level L holds every
/// vertex of the cell's first-level triangles, and every vertex that these slide to, from one to the next,
/// while the level asked for (nested_motion.hpp) is nowhere in the box above L: so all that is drawn of the
/// cell, whichever list draws it, and every vertex that lists up to that of level L + 1 leave out. Grows with
/// L. Kept as numbers of steps, rounded outwards: 384 bytes a level.
struct CellBoxes {
    static constexpr std::size_t kCells = 64;
    /// Levels above the block's last that there are boxes for, where the parent's block has them.
    static constexpr int kLevelsBeyond = 3;

    using Side = std::array<std::uint8_t, kCells>;
    /// Undefined for a cell without triangles.
    struct Level {
        std::array<Side, 3> low{}, high{};  ///< by axis
        bool operator==(const Level&) const = default;
    };

    Ecef centre{0.0};
    glm::dmat3 axes{1.0};    ///< columns: unit vectors
    glm::vec3 origin{0.0F};  ///< local metres of step 0
    glm::vec3 step_m{1.0F};  ///< by axis
    float radius_m = 0.0F;   ///< of a ball around the centre that holds all boxes
    std::uint8_t first_level = 0;
    std::vector<Level> levels;  ///< from first_level; empty for a grid
    /// By level: of a ball around the centre that holds the boxes of that level, metres.
    std::vector<float> level_radius_m;

    [[nodiscard]] int last_level() const { return first_level + static_cast<int>(levels.size()) - 1; }
    [[nodiscard]] const Level& at(int level) const {
        return levels[static_cast<std::size_t>(level - first_level)];
    }
};

/// The last level that there are boxes for. `parent` is the parent's block, nullptr for a root.
[[nodiscard]] int last_box_level(const Block& block, const Block* parent);

/// `parent` is the parent's block, nullptr for a root. About 0.1 ms.
[[nodiscard]] CellBoxes cell_boxes(const Block& block, const Block* parent);

}  // namespace eyepoint::terrain
