/// Goal 19: the default beside the four published methods, at equal post error.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "tools/bench/goals/goal_bench.hpp"
#include "tools/bench/goals/goal_report.hpp"
#include "tools/bench/scenes_by_turns.hpp"

namespace eyepoint::tools {

/// One path by one method, at the tolerance that gives the post error compared at.
struct MatchedMethod {
    std::string name;
    double tau_px = 0.0;
    double triangles = 0.0;         ///< mean
    std::vector<TurnFrame> frames;  ///< the same eyes for all methods
};

/// Triangles over the fewest of the published ones', and frame CPU over that of the one that it is the least
/// ahead of. published: not empty.
[[nodiscard]] std::vector<GoalLine> default_goals(const MatchedMethod& it,
                                                  std::span<const MatchedMethod> published);

/// Cruise at kComparedP999Px, drawn by turns.
[[nodiscard]] GoalDone measure_default(GoalBench& bench, GoalReport& report);

}  // namespace eyepoint::tools
