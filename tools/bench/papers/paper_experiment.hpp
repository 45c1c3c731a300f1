/// What every published experiment is given.
#pragma once

#include <cstddef>
#include <filesystem>

#include <tl/expected.hpp>

#include "tools/bench/papers/paper_table.hpp"

namespace eyepoint::tools {

struct PaperSettings {
    std::filesystem::path programs;     ///< folder of Eyepoint's programs
    std::filesystem::path synth_field;  ///< database of eyepoint-terrain synth --benchmark-field
    std::filesystem::path benchmark;    ///< folder of the benchmark field and its paths; empty: not there
    /// Database of a cut of 2049 x 2049 posts; empty: the synthetic field.
    std::filesystem::path cut_field;
    double seconds = 30.0;   ///< of flight, at 30 frames a second
    std::size_t every = 90;  ///< post error is measured in one frame of so many
};

/// On failure: one sentence.
using PaperExperiment = tl::expected<PaperTable, std::string> (*)(const PaperSettings& settings);

}  // namespace eyepoint::tools
