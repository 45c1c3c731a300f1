/// Goals 10, 11 and 12: what a frame may cost, by a flight's result.
#pragma once

#include <vector>

#include "tools/bench/goals/goal_bench.hpp"
#include "tools/bench/goals/goal_report.hpp"
#include "tools/bench/regression/flight_result.hpp"

namespace eyepoint::tools {

// Each has lines for the columns and figures that the result has.

/// 10: price of level of detail, p99 and p99.9 over the median, new programs and state pairs after the first
/// frame.
[[nodiscard]] std::vector<GoalLine> price_goals(const FlightResult& result);
/// 11: reading a frame back against a copy of the same bytes.
[[nodiscard]] std::vector<GoalLine> readback_goals(const FlightResult& result);
/// 12: time outside GL a frame of 25,000 triangles, heap allocations in frames that upload nothing.
[[nodiscard]] std::vector<GoalLine> frame_thread_goals(const FlightResult& result);
/// All of them.
[[nodiscard]] std::vector<GoalLine> frame_goals(const FlightResult& result);

/// Draws the settings' recorded flight at 60 Hz, 960 x 540 pixels, tau 2; where none is set, cruise.
[[nodiscard]] GoalDone measure_frames(GoalBench& bench, GoalReport& report);

}  // namespace eyepoint::tools
