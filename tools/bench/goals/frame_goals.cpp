#include "tools/bench/goals/frame_goals.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "config/settings.hpp"
#include "tools/bench/bench_run.hpp"
#include "tools/bench/eyes.hpp"
#include "tools/bench/median.hpp"
#include "tools/bench/regression/bench_result_columns.hpp"
#include "tools/bench/regression/flight_ratios.hpp"

namespace eyepoint::tools {

namespace {

constexpr double kTrianglesOfGoal = 25000.0;

/// Median time outside GL of the frames with about as many triangles as the goal is stated for; where no
/// frame has, of all frames, times what they have fewer or more.
std::optional<double> outside_gl_ms(const FlightResult& result) {
    const auto *outside_ms = result.find("outside_gl_ms"), *triangles = result.find("triangles");
    if (outside_ms == nullptr || triangles == nullptr) return std::nullopt;
    std::vector<double> scaled_ms;
    for (std::size_t i = 0; i < result.frames; ++i)
        scaled_ms.push_back((*outside_ms)[i] * kTrianglesOfGoal / std::max((*triangles)[i], 1.0));
    return median(std::move(scaled_ms));
}

/// The driver has the states of another mesh to leave again.
bool after_still(const FlightResult& result, std::size_t frame) {
    const auto* still_ms = result.find("still_cpu_ms");
    return still_ms != nullptr && frame > 0 && (*still_ms)[frame - 1] > 0.0;
}

/// Of a column, over the frames after the first that `counts`.
template <typename Counts>
double sum_after_first(const std::vector<double>& column, const Counts& counts) {
    double sum = 0.0;
    for (std::size_t i = 1; i < column.size(); ++i) sum += counts(i) ? column[i] : 0.0;
    return sum;
}

tl::expected<std::vector<ig::FlightEye>, std::string> eyes_of(const GoalBench& bench) {
    constexpr ig::PictureSize kSize{960, 540};
    constexpr double kRateHz = 60.0;
    const GoalSettings& settings = bench.settings();
    if (!settings.flight) return read_eyes({.file = settings.paths / "cruise.csv", .size = kSize});
    return read_eyes({.file = *settings.flight,
                      .size = kSize,
                      .vertical_fov_deg = config::ViewSettings{}.vertical_fov_deg,
                      .rate_hz = kRateHz});
}

}  // namespace

std::vector<GoalLine> price_goals(const FlightResult& result) {
    const std::map<std::string, double> targets{
        {"price_of_lod", 1.10}, {"p99_over_median", 1.25}, {"p999_over_median", 1.5}};
    std::vector<GoalLine> lines;
    for (const FlightRatio& ratio : flight_ratios(result)) {
        const auto target = targets.find(ratio.key);
        if (target != targets.end())
            lines.push_back(at_most(10, ratio.what, ratio.interval().value, target->second));
    }
    if (const auto* pairs = result.find("new_state_pairs"))
        lines.push_back(at_most(10, "new programs and state pairs after the first frame",
                                sum_after_first(*pairs, [](std::size_t) { return true; }), 0.0));
    return lines;
}

std::vector<GoalLine> readback_goals(const FlightResult& result) {
    const auto read_ms = result.figures.find("readback_ms"), copy_ms = result.figures.find("copy_ms");
    if (read_ms == result.figures.end() || copy_ms == result.figures.end()) return {};
    return {
        at_most(11, "reading a frame back over copying its bytes", read_ms->second / copy_ms->second, 1.1)};
}

std::vector<GoalLine> frame_thread_goals(const FlightResult& result) {
    std::vector<GoalLine> lines;
    if (const auto outside_ms = outside_gl_ms(result))
        lines.push_back(at_most(12, "frame thread outside GL at 25,000 triangles", *outside_ms, 0.5, "ms"));
    const auto *allocations = result.find("allocations"), *uploads = result.find("blocks_uploaded");
    if (allocations != nullptr && uploads != nullptr)
        lines.push_back(at_most(
            12, "heap allocations of the frame thread in frames without uploads",
            sum_after_first(*allocations,
                            [&](std::size_t i) { return (*uploads)[i] == 0.0 && !after_still(result, i); }),
            0.0));
    return lines;
}

std::vector<GoalLine> frame_goals(const FlightResult& result) {
    std::vector<GoalLine> lines;
    for (const auto& some : {price_goals(result), readback_goals(result), frame_thread_goals(result)})
        lines.insert(lines.end(), some.begin(), some.end());
    return lines;
}

GoalDone measure_frames(GoalBench& bench, GoalReport& report) {
    constexpr std::uint64_t kStillEvery = 5;
    const GoalSettings& settings = bench.settings();
    const auto eyes = eyes_of(bench);
    if (!eyes) return tl::unexpected(eyes.error());
    BenchOptions options;
    options.terrain = settings.flight ? settings.flight_terrain : settings.terrain;
    options.size = {960, 540};
    options.scene.lod_method = settings.lod_method;
    options.scene.shading = ig::Shading::Deferred;
    options.still_every = kStillEvery;
    options.allocations = settings.allocations;
    const auto bench_result = run_bench(options, *eyes);
    if (!bench_result) return tl::unexpected(bench_result.error());
    const FlightResult result = flight_result(*bench_result, {});
    for (GoalLine& line : frame_goals(result)) report.add(std::move(line));
    const auto& triangles = *result.find("triangles");
    report.note(
        fmt::format("Goals 10 to 12: {}, {} frames of {} x {}, tau {} px, {:.0f} triangles a frame.",
                    settings.flight ? settings.flight->filename().string() : "cruise", result.frames,
                    options.size.width_px, options.size.height_px, options.scene.tau_px,
                    std::reduce(triangles.begin(), triangles.end()) / static_cast<double>(result.frames)));
    return {};
}

}  // namespace eyepoint::tools
