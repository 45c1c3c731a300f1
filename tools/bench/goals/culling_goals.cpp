#include "tools/bench/goals/culling_goals.hpp"

#include <array>
#include <limits>

#include <fmt/format.h>

#include "tools/bench/goals/drawing_goals.hpp"

namespace eyepoint::tools {

namespace {

struct NamedPath {
    const char* name;
    const std::vector<ig::FlightEye>& eyes;
};

/// Cruise at its matched tolerance, with nothing left out and with.
struct WithAndWithout {
    FlightFigures whole, culled;
};

tl::expected<WithAndWithout, std::string> fly_both(GoalBench& bench, const std::vector<ig::FlightEye>& eyes) {
    const std::string& method = bench.settings().lod_method;
    const auto match = bench.match(method, bench.paths().cruise);
    if (!match) return tl::unexpected(match.error());
    auto whole = bench.fly(eyes, {method, match->tau_px}, kSelectionAlone);
    if (!whole) return tl::unexpected(whole.error());
    auto culled = bench.fly(eyes, {method, match->tau_px, 0.0, true}, kSelectionAlone);
    if (!culled) return tl::unexpected(culled.error());
    return WithAndWithout{*std::move(whole), *std::move(culled)};
}

double hidden_percent(const FlightFigures& culled) {
    const double all = culled.triangles_mean + culled.hidden_mean;
    return all > 0.0 ? 100.0 * culled.hidden_mean / all : 0.0;
}

}  // namespace

GoalLine hidden_goal(const std::string& path, const FlightFigures& culled, double least_percent) {
    return at_least(9, "triangles that horizon culling leaves out, " + path, hidden_percent(culled),
                    least_percent, "%");
}

GoalLine unchanged_goal(std::span<const TurnFrame> culled) {
    std::uint64_t changed = 0;
    for (const TurnFrame& frame : culled) changed += frame.pixels_changed;
    return at_most(9, fmt::format("pixels that horizon culling changes, {} pictures", culled.size()),
                   static_cast<double>(changed), 0.0);
}

GoalLine culling_price_goal(const std::string& path, std::span<const TurnFrame> whole,
                            std::span<const TurnFrame> culled) {
    double cost_ms = 0.0, saved_ms = 0.0;
    for (std::size_t i = 0; i < whole.size(); ++i) {
        cost_ms += culled[i].selection_ms - whole[i].selection_ms;
        saved_ms += (whole[i].cpu_ms - whole[i].selection_ms) - (culled[i].cpu_ms - culled[i].selection_ms);
    }
    const double share =
        saved_ms > 0.0 ? 100.0 * cost_ms / saved_ms : std::numeric_limits<double>::infinity();
    return at_most(9, "CPU of horizon culling over what it saves, " + path, share, 10.0, "%");
}

GoalLine culling_cost_goal(const std::string& path, const FlightFigures& whole, const FlightFigures& culled) {
    return at_most(9, "CPU of horizon culling where it hides nothing, " + path,
                   (culled.selection_us_mean - whole.selection_us_mean) * 1e-3, 0.1, "ms");
}

GoalDone measure_hidden(GoalBench& bench, GoalReport& report) {
    struct Path {
        NamedPath path;
        double least_percent;
    };
    const GoalPaths& paths = bench.paths();
    for (const Path& path : {Path{{"cruise", paths.cruise}, 30.0},
                             Path{{"cruise 300 m above ground", paths.low_cruise}, 65.0}}) {
        const auto both = fly_both(bench, path.path.eyes);
        if (!both) return tl::unexpected(both.error());
        const FlightFigures& culled = both->culled;
        report.add(hidden_goal(path.path.name, culled, path.least_percent));
        report.note(
            fmt::format("{}: {:.0f} triangles drawn of {:.0f}; selection {:.0f} us a frame (median), {:.0f} "
                        "without culling.",
                        path.path.name, culled.triangles_mean, culled.triangles_mean + culled.hidden_mean,
                        culled.selection_us_median, both->whole.selection_us_median));
    }
    return {};
}

GoalDone measure_culled_frames(GoalBench& bench, GoalReport& report) {
    const std::string& method = bench.settings().lod_method;
    const auto match = bench.match(method, bench.paths().cruise);
    if (!match) return tl::unexpected(match.error());
    std::vector scenes{goal_scene(method, match->tau_px), goal_scene(method, match->tau_px)};
    scenes.back().horizon_culling = true;
    std::vector<TurnFrame> all_culled;
    for (const NamedPath& path : {NamedPath{"cruise", bench.paths().cruise},
                                  NamedPath{"cruise 300 m above ground", bench.paths().low_cruise}}) {
        const auto frames = draw_by_turns(bench.field(), scenes, every_nth(path.eyes, bench.settings().every),
                                          kGoalPicture, {.pictures = true});
        if (!frames) return tl::unexpected(frames.error());
        report.add(culling_price_goal(path.name, frames->front(), frames->back()));
        all_culled.insert(all_culled.end(), frames->back().begin(), frames->back().end());
    }
    report.add(unchanged_goal(all_culled));
    return {};
}

GoalDone measure_idle_culling(GoalBench& bench, GoalReport& report) {
    for (const NamedPath& path :
         {NamedPath{"looking straight down", bench.paths().down_cruise},
          NamedPath{"5,000 m up, looking 45 degrees down", bench.paths().high_cruise}}) {
        const auto both = fly_both(bench, path.eyes);
        if (!both) return tl::unexpected(both.error());
        report.add(culling_cost_goal(path.name, both->whole, both->culled));
        report.note(
            fmt::format("{}: {:.1f}% of the triangles hidden.", path.name, hidden_percent(both->culled)));
    }
    return {};
}

}  // namespace eyepoint::tools
