/// A shaded relief picture of a terrain database.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "terrain/database/database.hpp"

namespace eyepoint::tools {

/// RGB triples, north row first.
struct ReliefPicture {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgb;
};

/// Plate carree, true to scale in the middle latitude; the longer side has longest_px pixels. Light from the
/// north-west, hypsometric tints by height above mean sea level. Slopes are as steep as they are where the
/// picture's pixels are small, and exaggerated where they are kilometres wide. On failure: one sentence.
[[nodiscard]] tl::expected<ReliefPicture, std::string> draw_relief(const terrain::Database& database,
                                                                   const terrain::GeographicExtent& extent,
                                                                   int longest_px);

}  // namespace eyepoint::tools
