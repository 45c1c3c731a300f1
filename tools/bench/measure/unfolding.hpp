/// What it takes to make a stored tile ready to draw, and what nested meshes take on disk.
#pragma once

#include <cstddef>
#include <string>

#include <tl/expected.hpp>

#include "terrain/database/database.hpp"

namespace eyepoint::tools {

struct UnfoldingTimes {
    std::size_t tiles = 0;
    double median_ms = 0.0, most_ms = 0.0;  ///< unfolding a nested mesh, CPU of one thread
    double read_median_ms = 0.0;            ///< reading and decoding block and mesh before that
    double mesh_bits_a_post = 0.0;          ///< stored, of all tiles' own 32 x 32 posts
};

/// Of about so many tiles, taken evenly from all there are. On failure (unreadable tile): one sentence.
[[nodiscard]] tl::expected<UnfoldingTimes, std::string> time_unfolding(const terrain::Database& database,
                                                                       std::size_t tiles);

}  // namespace eyepoint::tools
