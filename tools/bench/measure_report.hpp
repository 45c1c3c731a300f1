/// A measured flight's figures, for people and for programs.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "tools/bench/measure/flight_measure.hpp"

namespace eyepoint::tools {

/// A table, one figure a line.
[[nodiscard]] std::string describe(const FlightFigures& figures);

/// Keys with units; pixels of percentiles to 0.1%.
[[nodiscard]] nlohmann::json to_json(const FlightFigures& figures);
[[nodiscard]] nlohmann::json to_json(const FrameMeasure& frame);

}  // namespace eyepoint::tools
