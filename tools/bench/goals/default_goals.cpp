#include "tools/bench/goals/default_goals.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "tools/bench/goals/drawing_goals.hpp"
#include "tools/bench/median.hpp"

namespace eyepoint::tools {

namespace {

tl::expected<std::vector<MatchedMethod>, std::string> draw_matched(GoalBench& bench,
                                                                   std::span<const std::string> methods) {
    const auto& cruise = bench.paths().cruise;
    std::vector<MatchedMethod> matched;
    std::vector<ig::SceneOptions> scenes;
    for (const std::string& name : methods) {
        const auto match = bench.match(name, cruise);
        if (!match) return tl::unexpected(name + ": " + match.error());
        matched.push_back({name, match->tau_px, match->figures.triangles_mean, {}});
        scenes.push_back(goal_scene(name, match->tau_px));
    }
    auto frames =
        draw_by_turns(bench.field(), scenes, every_nth(cruise, bench.settings().every), kGoalPicture, {});
    if (!frames) return tl::unexpected(frames.error());
    for (std::size_t i = 0; i < matched.size(); ++i) matched[i].frames = std::move((*frames)[i]);
    return matched;
}

}  // namespace

std::vector<GoalLine> default_goals(const MatchedMethod& it, std::span<const MatchedMethod> published) {
    const auto fewest = std::ranges::min_element(published, {}, &MatchedMethod::triangles);
    double most = 0.0;
    std::string nearest;
    for (const MatchedMethod& other : published) {
        const double ratio = frame_ratio({other.frames, it.frames});
        if (ratio <= most) continue;
        most = ratio;
        nearest = other.name;
    }
    const std::string where = fmt::format(", both at p99.9 <= {} px, cruise", kComparedP999Px);
    return {at_most(19, fmt::format("{}, triangles over those of {}{}", it.name, fewest->name, where),
                    it.triangles / fewest->triangles, 1.0),
            at_most(19, fmt::format("{}, frame CPU over that of {}{}", it.name, nearest, where), most, 1.0)};
}

GoalDone measure_default(GoalBench& bench, GoalReport& report) {
    const std::vector<std::string> methods{bench.settings().lod_method, "selective", "bintree", "tile",
                                           "hyperblock"};
    const auto matched = draw_matched(bench, methods);
    if (!matched) return tl::unexpected(matched.error());
    for (GoalLine& line : default_goals(matched->front(), std::span(*matched).subspan(1)))
        report.add(std::move(line));
    std::string note = "Goal 19:";
    for (const MatchedMethod& method : *matched)
        note += fmt::format(" {} at tau {:.2f}, {:.0f} triangles, {:.1f} ms of CPU;", method.name,
                            method.tau_px, method.triangles,
                            median_of(method.frames, [](const TurnFrame& frame) { return frame.cpu_ms; }));
    report.note(std::move(note));
    return {};
}

}  // namespace eyepoint::tools
