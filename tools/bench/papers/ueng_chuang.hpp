/// Ueng & Chuang, LOD caching and dikes: tables 1 to 3.
#pragma once

#include "tools/bench/papers/paper_experiment.hpp"

namespace eyepoint::tools {

/// `selective` with the paper's screen error over 20 x 20 blocks: uncached, with the paper's four-corner
/// test, and with the sound one; and the default method at the same post error. Needs
/// PaperSettings::benchmark; without it the table has no rows.
[[nodiscard]] tl::expected<PaperTable, std::string> ueng_chuang_tables_1_to_3(const PaperSettings& settings);

}  // namespace eyepoint::tools
