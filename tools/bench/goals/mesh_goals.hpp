/// Goals 1, 2 and 5: what is drawn, and how far that is from the truth and from the frame before.
#pragma once

#include "tools/bench/goals/goal_bench.hpp"
#include "tools/bench/goals/goal_report.hpp"

namespace eyepoint::tools {

[[nodiscard]] GoalLine triangles_goal(const std::string& path, double triangles, double most);
[[nodiscard]] GoalLine post_error_goal(double tau_px, double slack_share, double worst_px);
[[nodiscard]] GoalLine jump_goal(double tau_px, double largest_px);

/// Triangles at the field's measure of comparison, without and with horizon culling.
[[nodiscard]] GoalDone measure_triangles(GoalBench& bench, GoalReport& report);
/// The largest error of a post at twelve pairs of tolerance and slack, and faults of the meshes drawn then.
[[nodiscard]] GoalDone measure_post_error(GoalBench& bench, GoalReport& report);
/// Jumps of posts between frames, with morph and without.
[[nodiscard]] GoalDone measure_jumps(GoalBench& bench, GoalReport& report);

}  // namespace eyepoint::tools
