#include "terrain/lod/hyperblock/block_selection.hpp"

#include <cstddef>

namespace eyepoint::terrain::hyperblock {

namespace {

class Traversal {
  public:
    Traversal(const HyperTree& tree, const EyeInTile& eye, const ScreenScale& scale,
              std::vector<BlockChoice>& choices)
        : tree_(tree), eye_(eye), scale_(scale), choices_(choices) {}

    void visit(const TreeNode& node, bool inside) {
        if (!inside) {
            const EyeInTile::Lies lies = eye_.lies(node.bounds, scale_);
            if (lies == EyeInTile::Lies::Outside) return;
            inside = lies == EyeInTile::Lies::Inside;
        }
        if (node.first_child < 0) {
            const auto block = static_cast<std::size_t>(node.block);
            choices_[block].level = level_of(tree_.blocks[block], node.bounds);
            return;
        }
        for (std::int16_t child = 0; child < 4; ++child)
            visit(tree_.nodes[static_cast<std::size_t>(node.first_child + child)], inside);
    }

  private:
    [[nodiscard]] std::int8_t level_of(const HyperBlock& block, const Sphere& bounds) const {
        const int finest = block.finest();
        if (finest == 0) return 0;
        const float distance_m = eye_.distance_m(bounds);
        int level = 0;
        while (level < finest && scale_.reach_m(block.level(level)) > distance_m) ++level;
        return static_cast<std::int8_t>(level);
    }

    const HyperTree& tree_;
    const EyeInTile& eye_;
    const ScreenScale& scale_;
    std::vector<BlockChoice>& choices_;
};

}  // namespace

std::vector<BlockChoice> no_choices(const HyperTree& tree) {
    std::vector<BlockChoice> choices(tree.blocks.size());
    for (std::size_t i = 0; i < choices.size(); ++i) choices[i].depth = tree.blocks[i].depth;
    return choices;
}

void select_blocks(const HyperTree& tree, const EyeInTile& eye, const ScreenScale& scale,
                   std::vector<BlockChoice>& choices) {
    for (BlockChoice& choice : choices) {
        choice.level = BlockChoice::kCulled;
        choice.border = 0;
    }
    Traversal(tree, eye, scale, choices).visit(tree.nodes.front(), false);
}

}  // namespace eyepoint::terrain::hyperblock
