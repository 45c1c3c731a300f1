/// Goal 6: what making, storing and unfolding blocks takes.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "tools/bench/goals/goal_bench.hpp"
#include "tools/bench/goals/goal_report.hpp"
#include "tools/bench/measure/unfolding.hpp"

namespace eyepoint::tools {

[[nodiscard]] std::vector<GoalLine> block_goals(const UnfoldingTimes& times);
/// Millions of posts a minute and core; none: not measured.
[[nodiscard]] GoalLine compiler_goal(std::optional<double> million_posts_a_minute);

[[nodiscard]] GoalDone measure_blocks(GoalBench& bench, GoalReport& report);
/// Builds the field again from its DEM, to depth 12, by CPU time of all its threads; where the DEM is not
/// beside the paths, a note says so.
[[nodiscard]] GoalDone measure_compiler(GoalBench& bench, GoalReport& report);

}  // namespace eyepoint::tools
