/// A block as bytes: quantised heights behind a gradient predictor, water, undulations, in one zstd frame
/// (docs/database-format.md, "Block").
/// Thread use: pure functions, from any thread.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "terrain/database/database.hpp"

namespace eyepoint::terrain {

/// Heights become whole multiples of height_step_m; decoding gives those back exactly.
[[nodiscard]] std::vector<std::uint8_t> encode_block(const BlockData& block, double height_step_m);

/// Any bytes may be given; on failure: the fault, without naming the file.
[[nodiscard]] tl::expected<BlockData, std::string> decode_block(TileId tile,
                                                                std::span<const std::uint8_t> bytes,
                                                                double height_step_m);

}  // namespace eyepoint::terrain
