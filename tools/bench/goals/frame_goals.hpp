/// What a frame may cost: goals measured on a flight's result.
#pragma once

#include <vector>

#include "tools/bench/goals/goal_line.hpp"
#include "tools/bench/regression/flight_result.hpp"

namespace eyepoint::tools {

/// Price of level of detail, p99 and p99.9 over the median, time outside GL a frame of 25,000 triangles, heap
/// allocations in frames that upload nothing, new programs and state pairs after the first frame, reading a
/// frame back against a copy of the same bytes; those that the result has columns and figures for. goal: the
/// number of the lines.
[[nodiscard]] std::vector<GoalLine> frame_goals(const FlightResult& result, int goal);

}  // namespace eyepoint::tools
