/// Larsen & Christensen, Real-time Terrain Rendering using Smooth Hardware Optimized Level of Detail (2003):
/// table 7.
#pragma once

#include "tools/bench/papers/paper_experiment.hpp"

namespace eyepoint::tools {

/// `tile` over one terrain at 513, 1025 and 2049 posts a side, with tiles of 17 and 33 posts, with morph and
/// without, by turns in one process: what morph costs; and the default method at the same post error. Needs
/// PaperSettings::benchmark; without it the table has no rows.
[[nodiscard]] tl::expected<PaperTable, std::string> larsen_christensen_table_7(const PaperSettings& settings);

}  // namespace eyepoint::tools
