#include "tools/bench/control/control_report.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

namespace eyepoint::tools {

namespace {

nlohmann::json to_json(const TargetScore& score) {
    return {{"target_ms", score.target_ms},
            {"median_ms", score.median_ms},
            {"p99_ms", score.p99_ms},
            {"worst_ms", score.worst_ms},
            {"share_within_10_percent", score.share_within},
            {"share_not_above_10_percent", score.share_not_above},
            {"worst_over_target", score.worst_ratio()},
            {"p99_over_median", score.p99_over_median()},
            {"share_at_bounds", score.share_at_bounds},
            {"tau_geometric_mean_px", std::exp(score.mean_log_tau)},
            {"tau_min_px", score.tau_min_px},
            {"tau_max_px", score.tau_max_px},
            {"triangles_mean", score.mean_triangles},
            {"reuse_share", score.reuse_share},
            {"reversals_per_s", score.reversals_per_s}};
}

/// What was said of frames that could not meet the target.
std::string describe_unreachable(std::span<const ControlledFrame> frames) {
    std::size_t coarsest = 0, held = 0;
    double most = 0.0;
    for (const ControlledFrame& frame : frames) {
        coarsest += frame.state == ig::ControlState::Coarsest ? 1 : 0;
        held += frame.state == ig::ControlState::Held ? 1 : 0;
        most = std::max(most, frame.unreachable_share);
    }
    if (coarsest + held == 0) return {};
    return fmt::format(
        "  target unreachable in {} frames at the coarsest tolerance and {} held; by up to {:.0f}%\n",
        coarsest, held, 100.0 * most);
}

}  // namespace

std::string describe(const TargetRun& run) {
    const TargetScore &control = run.control, &fixed = run.beside;
    std::string text =
        fmt::format("{}: target {:.2f} ms (floor {:.2f} ms), {} frames\n  {:<34}{:>12}{:>12}\n", run.name,
                    control.target_ms, run.floor_ms, run.controlled.size(), "", "controlled", "fixed tau");
    const auto row = [&](const char* what, double left, double right) {
        text += fmt::format("  {:<34}{:>12.3f}{:>12.3f}\n", what, left, right);
    };
    row("frames within 10% of the target, %", 100.0 * control.share_within, 100.0 * fixed.share_within);
    row("frames not above it by 10%, %", 100.0 * control.share_not_above, 100.0 * fixed.share_not_above);
    row("worst frame / target", control.worst_ratio(), fixed.worst_ratio());
    row("p99 / median", control.p99_over_median(), fixed.p99_over_median());
    row("median, ms", control.median_ms, fixed.median_ms);
    row("tau, geometric mean, px", std::exp(control.mean_log_tau), std::exp(fixed.mean_log_tau));
    row("tau, least, px", control.tau_min_px, fixed.tau_min_px);
    row("tau, greatest, px", control.tau_max_px, fixed.tau_max_px);
    row("frames at a bound of tau, %", 100.0 * control.share_at_bounds, 100.0 * fixed.share_at_bounds);
    row("reversals of tau a second", control.reversals_per_s, fixed.reversals_per_s);
    row("triangles, mean", control.mean_triangles, fixed.mean_triangles);
    row("choices of blocks reused, %", 100.0 * control.reuse_share, 100.0 * fixed.reuse_share);
    return text + describe_unreachable(run.controlled);
}

std::string describe(const StepScore& score) {
    return fmt::format("settles in {:.2f} s, overshoot {:.1f}%, {:.2f} reversals a second\n", score.settle_s,
                       100.0 * score.overshoot, score.reversals_per_s);
}

nlohmann::json to_json(const StepScore& score) {
    return {{"settle_s", score.settle_s},
            {"overshoot", score.overshoot},
            {"reversals_per_s", score.reversals_per_s}};
}

nlohmann::json to_json(std::span<const ControlledFrame> frames) {
    nlohmann::json json{{"cost_ms", nlohmann::json::array()},
                        {"tau_px", nlohmann::json::array()},
                        {"triangles", nlohmann::json::array()},
                        {"state", nlohmann::json::array()}};
    for (const ControlledFrame& frame : frames) {
        json["cost_ms"].push_back(frame.cost_ms);
        json["tau_px"].push_back(frame.tau_px);
        json["triangles"].push_back(frame.triangles);
        json["state"].push_back(ig::name(frame.state));
    }
    return json;
}

nlohmann::json to_json(const TargetRun& run) {
    return {{"name", run.name},
            {"floor_ms", run.floor_ms},
            {"controlled", to_json(run.control)},
            {"fixed_tau", to_json(run.beside)},
            {"controlled_frames", to_json(std::span(run.controlled))},
            {"fixed_frames", to_json(std::span(run.fixed))}};
}

}  // namespace eyepoint::tools
