/// A tile's picture as bytes: baseline JPEG, 4:4:4, north row first (docs/database-format.md, "Image").
/// Thread use: pure functions, from any thread.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "terrain/database/database.hpp"

namespace eyepoint::terrain {

/// rgb: kImageTexels^2 triples, row 0 in the south.
[[nodiscard]] tl::expected<std::vector<std::uint8_t>, std::string> encode_image(
    std::span<const std::uint8_t> rgb);

/// Any bytes may be given; on failure: the fault, without naming the file.
[[nodiscard]] tl::expected<ImageData, std::string> decode_image(TileId tile,
                                                                std::span<const std::uint8_t> bytes);

}  // namespace eyepoint::terrain
