/// Goal 17: memory of the method bintree (He, Wang & Liu), and blocks that come in time.
#pragma once

#include <vector>

#include "tools/bench/goals/goal_bench.hpp"
#include "tools/bench/goals/goal_report.hpp"
#include "tools/bench/regression/flight_result.hpp"

namespace eyepoint::tools {

/// Bytes a node of the mean frame, without what blocks know of their posts and with it.
[[nodiscard]] std::vector<GoalLine> node_goals(const FlightFigures& flown);
/// Memory, and frames that were short of a block; of a flight by draw_streamed().
[[nodiscard]] std::vector<GoalLine> streaming_goals(const FlightResult& drawn);

/// Cruise at tau 1 px: without drawing, then drawn while its blocks arrive.
[[nodiscard]] GoalDone measure_bintree(GoalBench& bench, GoalReport& report);

}  // namespace eyepoint::tools
