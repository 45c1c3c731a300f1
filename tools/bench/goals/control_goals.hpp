/// Goal 14: how near frames stay to a target that tolerance control is given.
#pragma once

#include <vector>

#include "tools/bench/control/control_score.hpp"
#include "tools/bench/goals/goal_bench.hpp"
#include "tools/bench/goals/goal_report.hpp"

namespace eyepoint::tools {

[[nodiscard]] std::vector<GoalLine> control_goals(const TargetScore& score);

/// Sweep at 1.5 times its own floor, by process CPU; of several flights the middle one.
[[nodiscard]] GoalDone measure_control(GoalBench& bench, GoalReport& report);

}  // namespace eyepoint::tools
