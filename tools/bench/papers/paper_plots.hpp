/// Published experiments as plots: the paper's figures and ours as lines of one plot.
#pragma once

#include <string>

#include "tools/bench/papers/paper_table.hpp"
#include "tools/report/plots_page.hpp"

namespace eyepoint::tools {

/// A table's plots. A plot has a series a line and figure, and beside it a dashed one in the same colour of
/// what the paper gives, where it gives any.
[[nodiscard]] PlotSection plots_of(const PaperTable& table);

/// A page with a section a table (plots_page.hpp).
[[nodiscard]] std::string plots_page(const PaperResults& results);

}  // namespace eyepoint::tools
