#include "terrain/lod/twist.hpp"

#include <algorithm>
#include <cmath>

namespace eyepoint::terrain {

/// Of the cells that are split from south-east to north-west.
float twist_m(const BlockData& data) {
    float greatest = 0.0F;
    for (int row = 0; row < kBlockCells; ++row) {
        for (int column = (row + 1) % 2; column < kBlockCells; column += 2) {
            const float rising = data.height_m(row, column) + data.height_m(row + 1, column + 1),
                        falling = data.height_m(row, column + 1) + data.height_m(row + 1, column);
            greatest = std::max(greatest, std::abs(rising - falling) * 0.5F);
        }
    }
    return greatest;
}

float Twists::of_m(const TileNode& node) {
    if (!node.info.has_children) return 0.0F;
    const auto [known, fresh] = known_m_.try_emplace(node.tile, 0.0F);
    if (fresh) known->second = twist_m(node.block->data);
    return known->second;
}

}  // namespace eyepoint::terrain
