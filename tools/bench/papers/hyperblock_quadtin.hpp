/// HyperBlock-QuadTIN, figures 14 to 16.
#pragma once

#include "tools/bench/papers/paper_experiment.hpp"

namespace eyepoint::tools {

/// `hyperblock` at hyperLevels 7 to 9 of the paper and by vertex, at tolerances from 0.25 to 4 pixels: frame
/// rate, triangles, selection time; and the default method at the same post error.
[[nodiscard]] tl::expected<PaperTable, std::string> hyperblock_figures_14_to_16(
    const PaperSettings& settings);

}  // namespace eyepoint::tools
