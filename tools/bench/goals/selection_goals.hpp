/// Goals 4 and 7: what selection takes.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "tools/bench/goals/goal_bench.hpp"
#include "tools/bench/goals/goal_report.hpp"

namespace eyepoint::tools {

/// Cruise at one tolerance.
struct SelectionAtTau {
    double tau_px = 0.0;
    FlightFigures figures;
};

/// Time and share of reuse at tau 1, time at all tolerances by its greatest over its least, heap allocations
/// at all of them together. `flights`: not empty, one of them at tau 1.
[[nodiscard]] std::vector<GoalLine> selection_goals(std::span<const SelectionAtTau> flights);
/// Of choosing what to draw, without cutting it into cells; none: not measured.
[[nodiscard]] GoalLine instructions_goal(std::optional<double> instructions_a_block);

/// Cruise at five tolerances.
[[nodiscard]] GoalDone measure_selection(GoalBench& bench, GoalReport& report);
/// Instructions by valgrind's callgrind, which runs `eyepoint-bench measure` and counts in selection alone;
/// where there is no valgrind, or it cannot count there, a note says so.
[[nodiscard]] GoalDone measure_instructions(GoalBench& bench, GoalReport& report);

}  // namespace eyepoint::tools
