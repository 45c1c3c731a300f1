/// What a run's ratios may be: stated bands, for a test with no second run to compare with.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "tools/bench/regression/comparison.hpp"

namespace eyepoint::tools {

struct Band {
    std::string key;  ///< of a FlightRatio
    double at_most = 0.0;
    std::string reason;  ///< for the band's width
};

/// JSON: {"KEY": {"at_most": NUMBER, "reason": "SENTENCE"}, ...}. On failure: one sentence.
[[nodiscard]] tl::expected<std::vector<Band>, std::string> read_bands(const std::filesystem::path& file);

/// A line for every band: worse where the run's ratio is above it, or where the run does not have it.
[[nodiscard]] std::vector<ComparedLine> judge(const FlightResult& result, const std::vector<Band>& bands);

}  // namespace eyepoint::tools
