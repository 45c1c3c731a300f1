/// He, Wang & Liu, An Improved Approach on Visualization of Large-Scale Terrain Surface (2007): table 1.
#pragma once

#include "tools/bench/papers/paper_experiment.hpp"

namespace eyepoint::tools {

/// `bintree` with 5,000, 10,000 and 20,000 faces over the synthetic field, blocks arriving as they are read:
/// frames a second, memory, what a node takes; and the default method at the same post error. Each flight is
/// a process of its own, so that its peak memory is its own.
[[nodiscard]] tl::expected<PaperTable, std::string> he_wang_liu_table_1(const PaperSettings& settings);

}  // namespace eyepoint::tools
