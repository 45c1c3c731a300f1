/// Checking a terrain database as a whole: that what it promises its readers is so.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "terrain/database/database.hpp"

namespace eyepoint::tools {

struct VerifyRequest {
    /// Paths from a root to a leaf, chosen by chance, on which delta_m is checked by brute force at chosen
    /// points.
    int delta_paths = 64;
    std::uint64_t seed = 1;
    /// Called from one thread at a time; may be empty.
    std::function<void(std::uint64_t done, std::uint64_t total)> progress;
};

/// Faults, a sentence each, in no particular order; empty when the database is sound. Checked: every block
/// and image decodes and its checksum is right; coarse posts are fine posts; posts on an edge that two tiles
/// share are equal, and beside a coarser tile lie on its edge; a pole has one height; height ranges hold the
/// heights; every tile has a nested mesh of sound structure that covers it once, with the levels from its
/// children's last (or the bare one) to its parent's first, and what stays of it are its parent's vertices;
/// delta_m bounds the distance of the surface (computed here anew, not by the compiler's code).
[[nodiscard]] std::vector<std::string> verify(const terrain::Database& database,
                                              const VerifyRequest& request);

}  // namespace eyepoint::tools
