#include "tools/bench/goals/drawing_goals.hpp"

#include <utility>

#include <fmt/format.h>

#include "tools/bench/median.hpp"

namespace eyepoint::tools {

namespace {

/// A vertex's level and target are in one word of it (terrain/block/block.hpp).
constexpr double kMorphBytes = 4.0;

double cpu_of(const TurnFrame& frame) { return frame.cpu_ms; }

tl::expected<std::vector<std::vector<TurnFrame>>, std::string> draw_cruise(
    const GoalBench& bench, std::span<const ig::SceneOptions> scenes, const TurnOptions& options) {
    return draw_by_turns(bench.field(), scenes, every_nth(bench.paths().cruise, bench.settings().every),
                         kGoalPicture, options);
}

}  // namespace

ig::SceneOptions goal_scene(const std::string& lod_method, double tau_px) {
    return {.lod_method = lod_method, .tau_px = tau_px, .slack = 0.0, .shading = ig::Shading::Deferred};
}

double frame_ratio(const DrawnPair& frames) {
    std::vector<double> ratios;
    for (std::size_t i = 0; i < frames.first.size(); ++i)
        ratios.push_back(frames.second[i].cpu_ms / frames.first[i].cpu_ms);
    return median(std::move(ratios));
}

GoalLine tile_goal(const DrawnPair& tile_and_method) {
    return at_most(
        3, fmt::format("frame CPU over that of tile, both at p99.9 <= {} px, cruise", kComparedP999Px),
        frame_ratio(tile_and_method), 0.5);
}

GoalLine floor_goal(std::span<const TurnFrame> frames) {
    return at_most(
        8, "frame CPU over the floor's, cruise",
        median_of(frames, [](const TurnFrame& frame) { return frame.cpu_ms / frame.floor_cpu_ms.value(); }),
        1.2);
}

std::vector<GoalLine> morph_goals(const DrawnPair& without_and_with) {
    return {at_most(5, "what morph adds to a frame's CPU, cruise",
                    100.0 * (frame_ratio(without_and_with) - 1.0), 2.0, "%"),
            at_most(5, "what morph adds to a vertex, bytes", kMorphBytes, 8.0)};
}

GoalLine tile_morph_goal(const DrawnPair& without_and_with) {
    return at_most(5, "what morph adds to a frame's CPU, cruise, method tile",
                   100.0 * (frame_ratio(without_and_with) - 1.0), 2.0, "%");
}

GoalDone measure_against_tile(GoalBench& bench, GoalReport& report) {
    const std::string& method = bench.settings().lod_method;
    const auto& cruise = bench.paths().cruise;
    const auto tile = bench.match("tile", cruise), match = bench.match(method, cruise);
    if (!tile) return tl::unexpected(tile.error());
    if (!match) return tl::unexpected(match.error());
    const std::vector scenes{goal_scene("tile", tile->tau_px), goal_scene(method, match->tau_px)};
    const auto frames = draw_cruise(bench, scenes, {});
    if (!frames) return tl::unexpected(frames.error());
    const DrawnPair pair{frames->front(), frames->back()};
    report.add(tile_goal(pair));
    const auto triangles = [](const TurnFrame& frame) { return static_cast<double>(frame.triangles); };
    report.note(
        fmt::format("Goal 3: {} at tau {:.2f}, {:.0f} triangles, {:.1f} ms of CPU (medians); tile "
                    "at tau {:.2f}, {:.0f}, {:.1f} ms.",
                    method, match->tau_px, median_of(pair.second, triangles), median_of(pair.second, cpu_of),
                    tile->tau_px, median_of(pair.first, triangles), median_of(pair.first, cpu_of)));
    return {};
}

GoalDone measure_against_floor(GoalBench& bench, GoalReport& report) {
    const std::string& method = bench.settings().lod_method;
    const auto match = bench.match(method, bench.paths().cruise);
    if (!match) return tl::unexpected(match.error());
    const std::vector scenes{goal_scene(method, match->tau_px)};
    const auto frames = draw_cruise(bench, scenes, {.floor = true});
    if (!frames) return tl::unexpected(frames.error());
    report.add(floor_goal(frames->front()));
    report.note(fmt::format(
        "Goal 8: a frame takes {:.1f} ms of CPU, its floor {:.1f} ms (medians).",
        median_of(frames->front(), cpu_of),
        median_of(frames->front(), [](const TurnFrame& frame) { return frame.floor_cpu_ms.value(); })));
    return {};
}

GoalDone measure_morph(GoalBench& bench, GoalReport& report) {
    const std::string& method = bench.settings().lod_method;
    const auto match = bench.match(method, bench.paths().cruise);
    if (!match) return tl::unexpected(match.error());
    const auto tile = bench.match("tile", bench.paths().cruise);
    if (!tile) return tl::unexpected(tile.error());
    std::vector scenes{goal_scene(method, match->tau_px), goal_scene(method, match->tau_px),
                       goal_scene("tile", tile->tau_px), goal_scene("tile", tile->tau_px)};
    scenes[0].morph = scenes[2].morph = false;
    const auto frames = draw_cruise(bench, scenes, {});
    if (!frames) return tl::unexpected(frames.error());
    for (GoalLine& line : morph_goals({(*frames)[0], (*frames)[1]})) report.add(std::move(line));
    report.add(tile_morph_goal({(*frames)[2], (*frames)[3]}));
    return {};
}

}  // namespace eyepoint::tools
