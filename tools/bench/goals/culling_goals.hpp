/// Goal 9: what horizon culling saves and takes.
#pragma once

#include <span>
#include <string>

#include "tools/bench/goals/goal_bench.hpp"
#include "tools/bench/goals/goal_report.hpp"
#include "tools/bench/scenes_by_turns.hpp"

namespace eyepoint::tools {

[[nodiscard]] GoalLine hidden_goal(const std::string& path, const FlightFigures& culled,
                                   double least_percent);
[[nodiscard]] GoalLine unchanged_goal(std::span<const TurnFrame> culled);
/// Of all eyes together: what selection takes more, over what the rest of the frame takes less, in CPU.
/// Nothing saved at a cost is missed.
[[nodiscard]] GoalLine culling_price_goal(const std::string& path, std::span<const TurnFrame> whole,
                                          std::span<const TurnFrame> culled);
/// Where there is nothing to hide.
[[nodiscard]] GoalLine culling_cost_goal(const std::string& path, const FlightFigures& whole,
                                         const FlightFigures& culled);

/// Triangles, selection alone.
[[nodiscard]] GoalDone measure_hidden(GoalBench& bench, GoalReport& report);
/// Pictures and frame CPU, on cruise and 700 m lower.
[[nodiscard]] GoalDone measure_culled_frames(GoalBench& bench, GoalReport& report);
/// Selection alone, looking straight down, and 45 degrees down from 5,000 m.
[[nodiscard]] GoalDone measure_idle_culling(GoalBench& bench, GoalReport& report);

}  // namespace eyepoint::tools
