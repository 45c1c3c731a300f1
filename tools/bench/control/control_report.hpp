/// What control came to, for people and for programs.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "tools/bench/control/control_score.hpp"

namespace eyepoint::tools {

/// A flight at one target a few times, with the same flight at the fixed tolerance of equal mean quality.
struct TargetRun {
    std::string name;       ///< of the target: "1.5 floors", "60 Hz"
    double floor_ms = 0.0;  ///< median of the flight at the coarsest tolerance
    std::vector<std::vector<ControlledFrame>> controlled;
    std::vector<ControlledFrame> fixed;
    std::vector<TargetScore> each;                      ///< of `controlled`
    double reuse_share = 0.0, reuse_share_fixed = 0.0;  ///< reuse_share() of the first flight, of `fixed`
    TargetScore middle, beside;                         ///< of middle_flight(controlled), of `fixed`
};

/// A table: a column a flight, the middle one, the fixed tolerance.
[[nodiscard]] std::string describe(const TargetRun& run);
[[nodiscard]] std::string describe(const StepScore& score);

/// Keys with units; frames as arrays of a value each.
[[nodiscard]] nlohmann::json to_json(const TargetRun& run);
[[nodiscard]] nlohmann::json to_json(const StepScore& score);
[[nodiscard]] nlohmann::json to_json(std::span<const ControlledFrame> frames);

}  // namespace eyepoint::tools
