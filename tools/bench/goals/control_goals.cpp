#include "tools/bench/goals/control_goals.hpp"

#include <cmath>

#include <fmt/format.h>

namespace eyepoint::tools {

namespace {

constexpr double kPathRateHz = 30.0;  // of the path
constexpr double kFloors = 1.5;
constexpr int kFlights = 3;
constexpr ig::ControlTarget kBounds{.tau_min_px = 0.1, .tau_max_px = 16.0, .nominal_tau_px = 2.0};

tl::expected<TargetScore, std::string> fly_controlled(ControlStage& stage,
                                                      const std::vector<ig::FlightEye>& eyes) {
    const auto coarsest = stage.fly(eyes, {.control = {}, .tau_px = kBounds.tau_max_px});
    if (!coarsest) return tl::unexpected(coarsest.error());
    ig::ControlTarget target = kBounds;
    target.frame_ms = kFloors * score(*coarsest, kBounds, 1.0, kPathRateHz).median_ms;
    std::vector<std::vector<ControlledFrame>> flights;
    for (int i = 0; i < kFlights; ++i) {
        auto flight = stage.fly(eyes, {.control = target});
        if (!flight) return tl::unexpected(flight.error());
        flights.push_back(*std::move(flight));
    }
    return score(middle_flight(flights), target, target.frame_ms, kPathRateHz);
}

}  // namespace

std::vector<GoalLine> control_goals(const TargetScore& score) {
    return {at_least(14, "frames within 10% of 1.5 floors, sweep", 100.0 * score.share_within, 95.0, "%"),
            at_most(14, "worst frame over the target, likewise", score.worst_ratio(), 1.25),
            at_most(14, "p99 over median, likewise", score.p99_over_median(), 1.25)};
}

GoalDone measure_control(GoalBench& bench, GoalReport& report) {
    ig::SceneOptions options;
    options.lod_method = bench.settings().lod_method;
    auto stage = ControlStage::create(bench.settings().terrain, options);
    if (!stage) return tl::unexpected(stage.error());
    const auto score = fly_controlled(*stage, bench.paths().sweep);
    if (!score) return tl::unexpected(score.error());
    for (GoalLine& line : control_goals(*score)) report.add(std::move(line));
    report.note(fmt::format(
        "Goal 14: target {:.1f} ms of process CPU; tau {:.2f} to {:.2f} px, mean {:.2f}; the "
        "middle of {} flights.",
        score->target_ms, score->tau_min_px, score->tau_max_px, std::exp(score->mean_log_tau), kFlights));
    return {};
}

}  // namespace eyepoint::tools
