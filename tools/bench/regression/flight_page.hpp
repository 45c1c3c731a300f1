/// A flight's result as a page to read.
#pragma once

#include <string>

#include <tl/expected.hpp>

#include "tools/bench/regression/flight_result.hpp"

namespace eyepoint::tools {

/// One HTML file that opens offline: ratios with their intervals, percentiles, plots. On failure: one
/// sentence.
[[nodiscard]] tl::expected<std::string, std::string> flight_page(const FlightResult& result);

}  // namespace eyepoint::tools
