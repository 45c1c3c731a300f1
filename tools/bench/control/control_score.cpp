#include "tools/bench/control/control_score.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "tools/bench/median.hpp"

namespace eyepoint::tools {

namespace {

constexpr double kSettledForS = 0.5;
constexpr double kNearBound = 0.005;

std::vector<double> smoothed_costs(std::span<const ControlledFrame> frames) {
    constexpr std::size_t kReach = 2;
    std::vector<double> costs;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        std::vector<double> near;
        const std::size_t end = std::min(frames.size(), i + kReach + 1);
        for (std::size_t j = i < kReach ? 0 : i - kReach; j < end; ++j) near.push_back(frames[j].cost_ms);
        costs.push_back(median(std::move(near)));
    }
    return costs;
}

/// The first frame from which costs stay near the target for half a second, or to the end.
std::size_t settled_at(std::span<const double> costs, double target_ms, double rate_hz) {
    const auto needed = static_cast<std::size_t>(kSettledForS * rate_hz);
    std::size_t since = 0;
    for (std::size_t i = 0; i < costs.size(); ++i) {
        if (std::abs(costs[i] / target_ms - 1.0) > kWithin) since = i + 1;
        if (i + 1 - since >= needed) return since;
    }
    return costs.size();
}

double overshoot(std::span<const double> costs, double target_ms) {
    const double side = costs.front() > target_ms ? 1.0 : -1.0;
    double farthest = 0.0;
    for (const double cost : costs) farthest = std::max(farthest, -side * (cost / target_ms - 1.0));
    return farthest;
}

}  // namespace

std::size_t reversals(std::span<const ControlledFrame> frames) {
    std::size_t turns = 0;
    double direction = 0.0, low = std::log(frames.front().tau_px), high = low;
    for (const ControlledFrame& frame : frames) {
        const double now = std::log(frame.tau_px);
        low = std::min(low, now);
        high = std::max(high, now);
        const double turned = now > low + kReversal && direction <= 0.0    ? 1.0
                              : now < high - kReversal && direction >= 0.0 ? -1.0
                                                                           : 0.0;
        if (turned == 0.0) continue;
        turns += direction != 0.0 ? 1 : 0;
        direction = turned;
        low = high = now;
    }
    return turns;
}

TargetScore score(std::span<const ControlledFrame> frames, const ig::ControlTarget& bounds, double target_ms,
                  double rate_hz) {
    const auto count = static_cast<double>(frames.size());
    TargetScore result{.target_ms = target_ms, .tau_min_px = frames.front().tau_px};
    std::vector<double> costs;
    for (const ControlledFrame& frame : frames) {
        costs.push_back(frame.cost_ms);
        const double ratio = frame.cost_ms / target_ms;
        result.share_within += std::abs(ratio - 1.0) <= kWithin ? 1.0 / count : 0.0;
        result.share_not_above += ratio <= 1.0 + kWithin ? 1.0 / count : 0.0;
        const bool bound = frame.tau_px <= bounds.tau_min_px * (1.0 + kNearBound) ||
                           frame.tau_px >= bounds.tau_max_px * (1.0 - kNearBound);
        result.share_at_bounds += bound ? 1.0 / count : 0.0;
        result.mean_log_tau += std::log(frame.tau_px) / count;
        result.tau_min_px = std::min(result.tau_min_px, frame.tau_px);
        result.tau_max_px = std::max(result.tau_max_px, frame.tau_px);
        result.mean_triangles += static_cast<double>(frame.triangles) / count;
    }
    std::ranges::sort(costs);
    result.median_ms = costs[costs.size() / 2];
    result.p99_ms = costs[std::min(costs.size() - 1, static_cast<std::size_t>(0.99 * count))];
    result.worst_ms = costs.back();
    result.reversals_per_s = static_cast<double>(reversals(frames)) * rate_hz / count;
    return result;
}

std::vector<ControlledFrame> middle_flight(std::span<const std::vector<ControlledFrame>> flights) {
    std::vector<ControlledFrame> middle = flights.front();
    for (std::size_t i = 0; i < middle.size(); ++i) {
        std::vector<double> costs;
        for (const auto& flight : flights) costs.push_back(flight[i].cost_ms);
        middle[i].cost_ms = median(std::move(costs));
    }
    return middle;
}

StepScore score_step(std::span<const ControlledFrame> frames, double target_ms, double rate_hz) {
    const std::vector<double> costs = smoothed_costs(frames);
    StepScore result{.settle_s = static_cast<double>(settled_at(costs, target_ms, rate_hz)) / rate_hz,
                     .overshoot = overshoot(costs, target_ms)};
    const auto second = static_cast<std::size_t>(rate_hz);
    if (frames.size() > second) {
        const auto steady = frames.subspan(second);
        result.reversals_per_s =
            static_cast<double>(reversals(steady)) * rate_hz / static_cast<double>(steady.size());
    }
    return result;
}

}  // namespace eyepoint::tools
