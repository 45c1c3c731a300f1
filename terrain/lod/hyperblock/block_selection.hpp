/// Hyper-block and basic block-level selection. Source: HyperBlock-QuadTIN, section 4.3, first stage.
#pragma once

#include <vector>

#include "terrain/lod/hyperblock/eye_in_tile.hpp"
#include "terrain/lod/hyperblock/hyper_tree.hpp"

namespace eyepoint::terrain::hyperblock {

/// The paper's selectedLevel and borderType. Not selected: level kCulled.
struct BlockChoice {
    static constexpr std::int8_t kCulled = -1;
    std::int8_t level = kCulled;
    BorderType border = 0;
    std::uint8_t depth =
        0;  ///< the block's own, beside its level so that neighbours are compared at a glance

    [[nodiscard]] bool selected() const { return level != kCulled; }
    bool operator==(const BlockChoice&) const = default;
};

/// Of a tree's blocks, none selected.
[[nodiscard]] std::vector<BlockChoice> no_choices(const HyperTree& tree);

/// By block of the tree: from the root down, what lies in the view volume, each with the coarsest level whose
/// error is at the tolerance at most; the finest one, if there is none. Border types are 0. `choices` began
/// as no_choices().
void select_blocks(const HyperTree& tree, const EyeInTile& eye, const ScreenScale& scale,
                   std::vector<BlockChoice>& choices);

}  // namespace eyepoint::terrain::hyperblock
