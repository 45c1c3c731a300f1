/// A block with nothing regular about it.
#pragma once

#include <memory>
#include <optional>
#include <random>

#include "terrain/block/block.hpp"

namespace eyepoint::testing {

/// A grid of random heights, 0 to 900 m.
[[nodiscard]] inline std::shared_ptr<const terrain::Block> rough_block(terrain::TileId tile) {
    terrain::BlockData data;
    data.tile = tile;
    std::mt19937 random(7);
    std::uniform_real_distribution<float> height_m(0.0F, 900.0F);
    for (float& height : data.heights_m) height = height_m(random);
    return terrain::unfold(data, std::nullopt);
}

}  // namespace eyepoint::testing
