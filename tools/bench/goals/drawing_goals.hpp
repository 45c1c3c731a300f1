/// Goals 3, 5, 8 and 9 as far as they are about drawing: scenes by turns on every so-manieth eye of a path.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "tools/bench/goals/goal_bench.hpp"
#include "tools/bench/goals/goal_report.hpp"
#include "tools/bench/scenes_by_turns.hpp"

namespace eyepoint::tools {

/// Frames of two scenes at the same eyes.
struct DrawnPair {
    std::span<const TurnFrame> first, second;
};

/// Median over eyes of the second's frame CPU over the first's.
[[nodiscard]] double frame_ratio(const DrawnPair& frames);

[[nodiscard]] GoalLine tile_goal(const DrawnPair& tile_and_method);
/// Of frames with floor_cpu_ms.
[[nodiscard]] GoalLine floor_goal(std::span<const TurnFrame> frames);
/// What morph adds to a frame and to a vertex.
[[nodiscard]] std::vector<GoalLine> morph_goals(const DrawnPair& without_and_with);

/// What morph adds to a frame of the method tile.
[[nodiscard]] GoalLine tile_morph_goal(const DrawnPair& without_and_with);

[[nodiscard]] GoalDone measure_against_tile(GoalBench& bench, GoalReport& report);
[[nodiscard]] GoalDone measure_against_floor(GoalBench& bench, GoalReport& report);
[[nodiscard]] GoalDone measure_morph(GoalBench& bench, GoalReport& report);

/// What a flight's scene is drawn with: deferred shading, no slack.
[[nodiscard]] ig::SceneOptions goal_scene(const std::string& lod_method, double tau_px);

}  // namespace eyepoint::tools
