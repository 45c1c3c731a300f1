/// Goal 16: what the cache of the method selective (Ueng & Chuang) saves, and what it leaves out.
#pragma once

#include <optional>
#include <vector>

#include "tools/bench/goals/goal_bench.hpp"
#include "tools/bench/goals/goal_report.hpp"

namespace eyepoint::tools {

/// One path at tau 1 px by the paper's screen error; with slack, every frame's vertices looked at.
struct SelectiveFlights {
    FlightFigures uncached;
    FlightFigures four_corner, sound;
};

/// CPU of selection and triangles against uncached; vertices missed with the paper's test, and those beyond
/// tau + s with the sound one.
[[nodiscard]] std::vector<GoalLine> selective_goals(const SelectiveFlights& flights);

/// Of choosing vertices and making their triangles, a frame; the cut through the quadtree and dikes left out.
struct GenerationInstructions {
    double uncached = 0.0, four_corner = 0.0, sound = 0.0;
    double a_rebuilt_post = 0.0;  ///< uncached, by the posts of the blocks that were made anew
};

/// None: not measured.
[[nodiscard]] std::vector<GoalLine> generation_goals(
    const std::optional<GenerationInstructions>& instructions);

/// Cruise, uncached and with both tests.
[[nodiscard]] GoalDone measure_selective(GoalBench& bench, GoalReport& report);
/// The same in instructions (profiled_flight.hpp); where there is no valgrind, or it cannot count there, a
/// note says so.
[[nodiscard]] GoalDone measure_generation(GoalBench& bench, GoalReport& report);

}  // namespace eyepoint::tools
