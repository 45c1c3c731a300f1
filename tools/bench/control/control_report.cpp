#include "tools/bench/control/control_report.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

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
        "  target unreachable: {} frames at the coarsest tolerance, {} held; by up to {:.0f}%\n", coarsest,
        held, 100.0 * most);
}

}  // namespace

std::string describe(const TargetRun& run) {
    std::string text = fmt::format("{}: target {:.2f} ms (floor {:.2f} ms), {} frames\n  {:<34}", run.name,
                                   run.beside.target_ms, run.floor_ms, run.fixed.size(), "");
    std::vector<TargetScore> columns = run.each;
    for (std::size_t i = 1; i <= run.each.size(); ++i)
        text += fmt::format("{:>12}", fmt::format("flight {}", i));
    if (run.each.size() > 1) {
        columns.push_back(run.middle);
        text += fmt::format("{:>12}", "middle");
    }
    columns.push_back(run.beside);
    text += fmt::format("{:>12}\n", "fixed tau");
    const auto row = [&](const char* what, const std::function<double(const TargetScore&)>& value) {
        text += fmt::format("  {:<34}", what);
        for (const TargetScore& column : columns) text += fmt::format("{:>12.3f}", value(column));
        text += '\n';
    };
    row("frames within 10% of the target, %", [](const auto& s) { return 100.0 * s.share_within; });
    row("frames not above it by 10%, %", [](const auto& s) { return 100.0 * s.share_not_above; });
    row("worst frame / target", [](const auto& s) { return s.worst_ratio(); });
    row("p99 / median", [](const auto& s) { return s.p99_over_median(); });
    row("median, ms", [](const auto& s) { return s.median_ms; });
    row("tau, geometric mean, px", [](const auto& s) { return std::exp(s.mean_log_tau); });
    row("tau, least, px", [](const auto& s) { return s.tau_min_px; });
    row("tau, greatest, px", [](const auto& s) { return s.tau_max_px; });
    row("frames at a bound of tau, %", [](const auto& s) { return 100.0 * s.share_at_bounds; });
    row("reversals of tau a second", [](const auto& s) { return s.reversals_per_s; });
    row("triangles, mean", [](const auto& s) { return s.mean_triangles; });
    text += fmt::format("  choices of blocks reused: {:.2f}% while tau moves, {:.2f}% while it stands\n",
                        100.0 * run.reuse_share, 100.0 * run.reuse_share_fixed);
    return text + describe_unreachable(run.controlled.front());
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
    nlohmann::json json{
        {"cost_ms", nlohmann::json::array()},       {"tau_px", nlohmann::json::array()},
        {"triangles", nlohmann::json::array()},     {"blocks_chosen", nlohmann::json::array()},
        {"blocks_reused", nlohmann::json::array()}, {"bytes_uploaded", nlohmann::json::array()},
        {"state", nlohmann::json::array()}};
    for (const ControlledFrame& frame : frames) {
        json["cost_ms"].push_back(frame.cost_ms);
        json["tau_px"].push_back(frame.tau_px);
        json["triangles"].push_back(frame.triangles);
        json["bytes_uploaded"].push_back(frame.bytes_uploaded);
        json["state"].push_back(ig::name(frame.state));
    }
    return json;
}

nlohmann::json to_json(const TargetRun& run) {
    nlohmann::json json{{"name", run.name},
                        {"floor_ms", run.floor_ms},
                        {"reuse_share", run.reuse_share},
                        {"reuse_share_fixed_tau", run.reuse_share_fixed},
                        {"middle", to_json(run.middle)},
                        {"fixed_tau", to_json(run.beside)},
                        {"fixed_frames", to_json(std::span(run.fixed))}};
    for (std::size_t i = 0; i < run.each.size(); ++i) {
        json["controlled"].push_back(to_json(run.each[i]));
        json["controlled_frames"].push_back(to_json(std::span(run.controlled[i])));
    }
    return json;
}

}  // namespace eyepoint::tools
