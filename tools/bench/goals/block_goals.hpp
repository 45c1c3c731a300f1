/// Goal 6: what making, storing and unfolding blocks takes.
#pragma once

#include <vector>

#include "tools/bench/goals/goal_bench.hpp"
#include "tools/bench/goals/goal_report.hpp"
#include "tools/bench/measure/unfolding.hpp"

namespace eyepoint::tools {

[[nodiscard]] std::vector<GoalLine> block_goals(const UnfoldingTimes& times);
[[nodiscard]] GoalLine compiler_goal(double million_posts_a_minute);

[[nodiscard]] GoalDone measure_blocks(GoalBench& bench, GoalReport& report);
/// Makes the nested meshes of the field's tiles anew, by CPU time of all threads; they go nowhere.
[[nodiscard]] GoalDone measure_compiler(GoalBench& bench, GoalReport& report);

}  // namespace eyepoint::tools
