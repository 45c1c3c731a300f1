/// How well a row of frames kept to a target.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "tools/bench/control/controlled_flight.hpp"

namespace eyepoint::tools {

struct TargetScore {
    double target_ms = 0.0;
    double median_ms = 0.0, p99_ms = 0.0, worst_ms = 0.0;
    double share_within = 0.0;                  ///< of frames within 10% of the target
    double share_not_above = 0.0;               ///< of frames at most 10% above it
    double share_at_bounds = 0.0;               ///< of frames drawn at a bound of tau
    double mean_log_tau = 0.0;                  ///< of the natural logarithm of pixels
    double tau_min_px = 0.0, tau_max_px = 0.0;  ///< seen
    double mean_triangles = 0.0;
    double reversals_per_s = 0.0;  ///< turns of tau by more than kReversal

    [[nodiscard]] double worst_ratio() const { return worst_ms / target_ms; }
    [[nodiscard]] double p99_over_median() const { return p99_ms / median_ms; }
};

inline constexpr double kWithin = 0.10;    ///< of the target
inline constexpr double kReversal = 0.02;  ///< of tau

/// `frames` not empty; `rate_hz`: frames a second of the flight; `bounds`: of tau.
[[nodiscard]] TargetScore score(std::span<const ControlledFrame> frames, const ig::ControlTarget& bounds,
                                double target_ms, double rate_hz);

/// The flights' middle one, frame by frame: what happens at random places, a machine's interruptions, is out
/// of it; what belongs to a place of the path is not. Costs are medians, the rest is the first flight's.
/// Flights of equal length, at least one.
[[nodiscard]] std::vector<ControlledFrame> middle_flight(
    std::span<const std::vector<ControlledFrame>> flights);

struct StepScore {
    double settle_s = 0.0;   ///< until the cost stays within 10% of the target for half a second; the whole
                             ///< time where it never does
    double overshoot = 0.0;  ///< farthest on the other side of the target after it was crossed, a share of it
    double reversals_per_s = 0.0;  ///< of tau, from the first second on
};

/// Frames from the step on. Costs are medians of five neighbours, for the clock's own noise is no
/// oscillation.
[[nodiscard]] StepScore score_step(std::span<const ControlledFrame> frames, double target_ms, double rate_hz);

/// Turns of log tau that go back by more than kReversal.
[[nodiscard]] std::size_t reversals(std::span<const ControlledFrame> frames);

}  // namespace eyepoint::tools
