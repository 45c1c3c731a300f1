/// Goals 13 and 15: the running program, with a host on the same machine.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tools/bench/goals/goal_bench.hpp"
#include "tools/bench/goals/goal_report.hpp"

namespace eyepoint::tools {

/// CPU of a program that stands still and draws on change, percent of a core.
[[nodiscard]] GoalLine idle_goal(double cpu_percent);
/// From each packet's arrival to its first whole frame, at 60 Hz; none: no packet was drawn, which is not
/// measured.
[[nodiscard]] GoalLine delay_goal(std::span<const double> delays_ms);

/// Delays of a frame record (docs/frame-record.md): one a packet that was drawn.
[[nodiscard]] std::vector<double> delays_of_record(const std::string& lines);

/// The host says the same place 30 times a second.
[[nodiscard]] GoalDone measure_idle(GoalBench& bench, GoalReport& report);
/// The host flies cruise at 60 packets a second.
[[nodiscard]] GoalDone measure_delay(GoalBench& bench, GoalReport& report);

}  // namespace eyepoint::tools
