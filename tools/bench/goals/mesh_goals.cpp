#include "tools/bench/goals/mesh_goals.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace eyepoint::tools {

namespace {

/// A path at the field's measure of comparison, nothing hidden left out.
GoalDone measure_path(GoalBench& bench, GoalReport& report, const std::string& name,
                      const std::vector<ig::FlightEye>& path, double most_triangles) {
    const auto match = bench.match(bench.settings().lod_method, path);
    if (!match) return tl::unexpected(match.error());
    const FlightFigures& figures = match->figures;
    report.add(triangles_goal(name + ", nothing hidden left out", figures.triangles_mean, most_triangles));
    report.note(fmt::format(
        "{}: p99.9 {:.3f} px (worst frame {:.3f}), max {:.3f}, rms {:.3f} at tau {:.3f}; triangles drawn: "
        "mean {:.0f}, median {:.0f}, of them slid shut {:.0f}; draws {:.0f}.",
        name, figures.posts.error.percentile(0.999), figures.worst_frame_p999_px,
        figures.posts.error.maximum(), figures.posts.error.rms(), match->tau_px, figures.triangles_mean,
        figures.triangles_median, figures.empty_mean, figures.draws_mean));
    return {};
}

/// What is wrong with meshes, over many flights.
struct MeshSum {
    PostFigures posts;
    MeshFaults faults;
};

tl::expected<double, std::string> worst_post_px(GoalBench& bench, double tau_px, double slack_share,
                                                MeshSum& sum) {
    double worst_px = 0.0;
    for (const auto* path : {&bench.paths().cruise, &bench.paths().sweep}) {
        const auto figures = bench.fly(*path, {bench.settings().lod_method, tau_px, slack_share},
                                       {.every = bench.settings().every, .pops = false});
        if (!figures) return tl::unexpected(figures.error());
        worst_px = std::max(worst_px, figures->posts.error.maximum());
        sum.posts.merge(figures->posts);
        sum.faults.cracks += figures->faults.cracks;
        sum.faults.overlaps += figures->faults.overlaps;
    }
    return worst_px;
}

void add_faults(const MeshSum& sum, GoalReport& report) {
    const auto none = [&](const std::string& what, std::uint64_t count) {
        report.add(at_most(2, what + ", over all of these", static_cast<double>(count), 0.0));
    };
    none("posts in view that nothing covers", sum.posts.uncovered);
    none("cracks in the drawn meshes", sum.faults.cracks);
    none("edges in more than two triangles", sum.faults.overlaps);
    report.note(
        fmt::format("Posts under a triangle that is folded over, over all flights of goal 2: {} of {}.",
                    sum.posts.folded, sum.posts.error.count()));
}

}  // namespace

GoalLine triangles_goal(const std::string& path, double triangles, double most) {
    return at_most(1, fmt::format("triangles at p99.9 <= {} px, {}", kComparedP999Px, path), triangles, most);
}

GoalLine post_error_goal(double tau_px, double slack_share, double worst_px) {
    return at_most(
        2, fmt::format("largest post error, cruise and sweep, tau {} px, s {} tau", tau_px, slack_share),
        worst_px, tau_px * (1.0 + slack_share), "px");
}

GoalLine jump_goal(double tau_px, double largest_px) {
    return at_most(5, fmt::format("largest jump of a post between frames, cruise, tau {:.2f} px", tau_px),
                   largest_px, 0.25, "px");
}

GoalDone measure_triangles(GoalBench& bench, GoalReport& report) {
    const GoalPaths& paths = bench.paths();
    if (auto done = measure_path(bench, report, "cruise", paths.cruise, 36000.0); !done) return done;
    if (auto done = measure_path(bench, report, "sweep", paths.sweep, 20000.0); !done) return done;
    const std::string& method = bench.settings().lod_method;
    const auto match = bench.match(method, paths.cruise);
    if (!match) return tl::unexpected(match.error());
    const auto culled = bench.fly(paths.cruise, {method, match->tau_px, 0.0, true}, kSelectionAlone);
    if (!culled) return tl::unexpected(culled.error());
    report.add(triangles_goal("cruise, with horizon culling", culled->triangles_mean, 26000.0));
    return {};
}

GoalDone measure_post_error(GoalBench& bench, GoalReport& report) {
    MeshSum sum;
    for (const double tau_px : {0.5, 1.0, 2.0, 4.0}) {
        for (const double slack_share : {0.0, 0.1, 0.2}) {
            const auto worst_px = worst_post_px(bench, tau_px, slack_share, sum);
            if (!worst_px) return tl::unexpected(worst_px.error());
            report.add(post_error_goal(tau_px, slack_share, *worst_px));
        }
    }
    add_faults(sum, report);
    return {};
}

GoalDone measure_jumps(GoalBench& bench, GoalReport& report) {
    const std::string& method = bench.settings().lod_method;
    const auto& cruise = bench.paths().cruise;
    const auto match = bench.match(method, cruise);
    if (!match) return tl::unexpected(match.error());
    MeasureOptions options{.every = bench.settings().every, .faults = false};
    const auto with = bench.fly(cruise, {method, match->tau_px, kSlackShare}, options);
    if (!with) return tl::unexpected(with.error());
    report.add(jump_goal(match->tau_px, with->pops.maximum()));
    options.morph = false;
    const auto without = bench.fly(cruise, {method, match->tau_px, kSlackShare}, options);
    if (!without) return tl::unexpected(without.error());
    report.note(
        fmt::format("Jumps: largest {:.3f} px, p99.9 {:.4f} px with morph; {:.3f} px and {:.4f} px without.",
                    with->pops.maximum(), with->pops.percentile(0.999), without->pops.maximum(),
                    without->pops.percentile(0.999)));
    return {};
}

}  // namespace eyepoint::tools
