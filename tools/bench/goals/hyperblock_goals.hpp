/// Goal 18: the method hyperblock against its twin that selects vertex by vertex, and at all tolerances.
#pragma once

#include <span>

#include "tools/bench/goals/drawing_goals.hpp"
#include "tools/bench/goals/goal_bench.hpp"
#include "tools/bench/goals/goal_report.hpp"
#include "tools/bench/goals/selection_goals.hpp"

namespace eyepoint::tools {

[[nodiscard]] GoalLine twin_goal(const DrawnPair& by_vertex_and_block);
/// By selection's median. Not empty.
[[nodiscard]] GoalLine flat_selection_goal(std::span<const SelectionAtTau> flights);

/// Cruise drawn by turns at tau 1 px; its selection from 0.25 to 4 px, with the same blocks at all of them,
/// as the paper's are.
[[nodiscard]] GoalDone measure_hyperblock(GoalBench& bench, GoalReport& report);

}  // namespace eyepoint::tools
