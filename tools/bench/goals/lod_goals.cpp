#include "tools/bench/goals/lod_goals.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "tools/bench/measure/tolerance_match.hpp"
#include "tools/bench/measure/unfolding.hpp"

namespace eyepoint::tools {

namespace {

using terrain::LodView;
constexpr double kSlackShare = 0.1;

std::vector<LodView> sample(const std::vector<LodView>& views, std::size_t every) {
    std::vector<LodView> result;
    for (std::size_t i = 0; i < views.size(); i += every) result.push_back(views[i]);
    return result;
}

/// No mesh is looked at.
MeasureOptions selection_alone(std::size_t frames) {
    return {.every = frames + 1, .posts = false, .pops = false, .faults = false};
}

}  // namespace

LodGoals::LodGoals(std::shared_ptr<const terrain::Database> field, GoalPaths paths, FlightOptions flight,
                   std::size_t every)
    : surface_(field),
      paths_(std::move(paths)),
      every_(every),
      field_(std::move(field)),
      flight_options_(std::move(flight)) {}

void LodGoals::line(GoalLine line) {
    if (report_) report_(line);
    figures_.lines.push_back(std::move(line));
}

tl::expected<FlightFigures, std::string> LodGoals::fly(std::vector<LodView> views, double tau_px,
                                                       double slack_share, const MeasureOptions& options) {
    for (LodView& view : views) {
        view.tau_px = tau_px;
        view.slack_px = slack_share * tau_px;
    }
    const auto frames = measure_flight(*flight_, surface_, views, options);
    if (!frames) return tl::unexpected(frames.error());
    return summarise(*frames);
}

LodGoals::Done LodGoals::triangles() {
    struct Path {
        const char* name;
        const std::vector<LodView>& views;
        double most_triangles;
    };
    for (const Path& path : {Path{"cruise", paths_.cruise, 36000.0}, Path{"sweep", paths_.sweep, 20000.0}}) {
        const auto match = match_p999(*flight_, surface_, sample(path.views, every_), kComparedP999Px, 0.0,
                                      MeasureOptions{});
        if (!match) return tl::unexpected(match.error());
        const FlightFigures& figures = match->figures;
        line({1,
              fmt::format("triangles at p99.9 <= {} px, {}, nothing hidden left out", kComparedP999Px,
                          path.name),
              figures.triangles_mean, GoalLine::Sense::AtMost, path.most_triangles, ""});
        if (&path.views == &paths_.cruise) matched_tau_px_ = match->tau_px;
        note(fmt::format(
            "{}: p99.9 {:.3f} px (worst frame {:.3f}), max {:.3f}, rms {:.3f} at tau {:.3f}; triangles "
            "drawn: mean {:.0f}, median {:.0f}, of them slid shut {:.0f}; draws {:.0f}.",
            path.name, figures.posts.error.percentile(0.999), figures.worst_frame_p999_px,
            figures.posts.error.maximum(), figures.posts.error.rms(), match->tau_px, figures.triangles_mean,
            figures.triangles_median, figures.empty_mean, figures.draws_mean));
    }
    return {};
}

LodGoals::Done LodGoals::culling() {
    FlightOptions options = flight_options_;
    options.cull = true;
    auto culled = LodFlight::create(field_, options);
    if (!culled) return tl::unexpected(culled.error());
    std::swap(flight_, *culled);
    struct Path {
        const char* name;
        const std::vector<LodView>& views;
        double least_percent;
    };
    for (const Path& path :
         {Path{"cruise", paths_.cruise, 30.0}, Path{"cruise 700 m lower", paths_.low_cruise, 65.0}}) {
        const auto figures = fly(path.views, matched_tau_px_, 0.0, selection_alone(path.views.size()));
        if (!figures) return tl::unexpected(figures.error());
        if (&path.views == &paths_.cruise) {
            line({1,
                  fmt::format("triangles at p99.9 <= {} px, cruise, with horizon culling", kComparedP999Px),
                  figures->triangles_mean, GoalLine::Sense::AtMost, 26000.0, ""});
        }
        const double whole = figures->triangles_mean + figures->hidden_mean;
        line({9, fmt::format("triangles that horizon culling leaves out, {}", path.name),
              whole > 0.0 ? 100.0 * figures->hidden_mean / whole : 0.0, GoalLine::Sense::AtLeast,
              path.least_percent, "%"});
        note(
            fmt::format("{}, culled: {:.0f} of {:.0f} triangles drawn; selection {:.0f} us a frame (median).",
                        path.name, figures->triangles_mean, whole, figures->selection_us_median));
    }
    std::swap(flight_, *culled);
    return {};
}

LodGoals::Done LodGoals::post_error() {
    PostFigures holes;
    MeshFaults faults;
    for (const double tau_px : {0.5, 1.0, 2.0, 4.0}) {
        for (const double slack_share : {0.0, 0.1, 0.2}) {
            double worst_px = 0.0;
            for (const auto* views : {&paths_.cruise, &paths_.sweep}) {
                const MeasureOptions options{.every = every_, .pops = false};
                const auto figures = fly(*views, tau_px, slack_share, options);
                if (!figures) return tl::unexpected(figures.error());
                worst_px = std::max(worst_px, figures->posts.error.maximum());
                holes.merge(figures->posts);
                faults.cracks += figures->faults.cracks;
                faults.overlaps += figures->faults.overlaps;
            }
            line({2,
                  fmt::format("largest post error, cruise and sweep, tau {} px, s {} tau", tau_px,
                              slack_share),
                  worst_px, GoalLine::Sense::AtMost, tau_px * (1.0 + slack_share), "px"});
        }
    }
    line({2, "posts in view that nothing covers, over all of these", static_cast<double>(holes.uncovered),
          GoalLine::Sense::AtMost, 0.0, ""});
    line({2, "cracks in the drawn meshes, over all of these", static_cast<double>(faults.cracks),
          GoalLine::Sense::AtMost, 0.0, ""});
    line({2, "edges in more than two triangles, over all of these", static_cast<double>(faults.overlaps),
          GoalLine::Sense::AtMost, 0.0, ""});
    note(fmt::format("Posts under a triangle that is folded over, over all of these: {} of {}.", holes.folded,
                     holes.error.count()));
    return {};
}

LodGoals::Done LodGoals::pops() {
    MeasureOptions options{.every = every_, .faults = false};
    const auto with = fly(paths_.cruise, matched_tau_px_, kSlackShare, options);
    if (!with) return tl::unexpected(with.error());
    line({5, fmt::format("largest jump of a post between frames, cruise, tau {:.2f} px", matched_tau_px_),
          with->pops.maximum(), GoalLine::Sense::AtMost, 0.25, "px"});
    options.morph = false;
    const auto without = fly(paths_.cruise, matched_tau_px_, kSlackShare, options);
    if (!without) return tl::unexpected(without.error());
    note(fmt::format("Jumps: largest {:.3f} px, p99.9 {:.4f} px with morph; {:.3f} px and {:.4f} px without.",
                     with->pops.maximum(), with->pops.percentile(0.999), without->pops.maximum(),
                     without->pops.percentile(0.999)));
    return {};
}

LodGoals::Done LodGoals::selection() {
    double least_ns = 0.0, most_ns = 0.0, reused = 0.0, ns_a_block = 0.0, us_a_400 = 0.0;
    std::uint64_t allocations = 0;
    std::string by_tau;
    for (const double tau_px : {0.25, 0.5, 1.0, 2.0, 4.0}) {
        const auto figures = fly(paths_.cruise, tau_px, kSlackShare, selection_alone(paths_.cruise.size()));
        if (!figures) return tl::unexpected(figures.error());
        const double ns = figures->median_ns_per_block;
        least_ns = least_ns > 0.0 ? std::min(least_ns, ns) : ns;
        most_ns = std::max(most_ns, ns);
        allocations += figures->allocations;
        by_tau += fmt::format(
            " tau {}: {:.1f} us a frame, {:.0f} blocks tested, {:.0f} drawn, {:.1f} ns each;", tau_px,
            figures->selection_us_median, figures->tested_mean, figures->blocks_drawn_mean, ns);
        if (tau_px != 1.0) continue;
        reused = figures->reused_share;
        ns_a_block = ns;
        us_a_400 = figures->selection_us_median / figures->blocks_drawn_mean * 400.0;
    }
    line({4, "selection, CPU a block tested, cruise, tau 1 px, s 0.1 tau (median)", ns_a_block,
          GoalLine::Sense::AtMost, 10.0, "ns"});
    line({4, "selection, CPU for 400 blocks drawn, likewise", us_a_400, GoalLine::Sense::AtMost, 20.0, "us"});
    line({4, "block evaluations avoided, likewise", 100.0 * reused, GoalLine::Sense::AtLeast, 99.0, "%"});
    line({4, "dearest tolerance over cheapest, CPU a block tested, tau 0.25 to 4 px", most_ns / least_ns,
          GoalLine::Sense::AtMost, 1.3, ""});
    line({7, "heap allocations in selection, cruise flown at these five tolerances",
          static_cast<double>(allocations), GoalLine::Sense::AtMost, 0.0, ""});
    note("Selection:" + by_tau);
    return {};
}

LodGoals::Done LodGoals::blocks() {
    constexpr std::size_t kTiles = 500;
    const auto unfolding = time_unfolding(*field_, kTiles);
    if (!unfolding) return tl::unexpected(unfolding.error());
    line({6, "unfolding a stored tile's nested mesh, CPU, median", unfolding->median_ms,
          GoalLine::Sense::AtMost, 0.3, "ms"});
    line({6, "nested meshes in the database, bits a post", unfolding->mesh_bits_a_post,
          GoalLine::Sense::AtMost, 8.0, ""});
    note(fmt::format(
        "Unfolding {} tiles: median {:.3f} ms, longest {:.3f} ms; reading and decoding {:.3f} ms.",
        unfolding->tiles, unfolding->median_ms, unfolding->most_ms, unfolding->read_median_ms));
    return {};
}

tl::expected<GoalFigures, std::string> LodGoals::measure(const std::function<void(const GoalLine&)>& report) {
    report_ = report;
    figures_ = {};
    auto flight = LodFlight::create(field_, flight_options_);
    if (!flight) return tl::unexpected(flight.error());
    flight_ = std::move(*flight);
    constexpr std::array kSteps{&LodGoals::triangles, &LodGoals::culling,   &LodGoals::post_error,
                                &LodGoals::pops,      &LodGoals::selection, &LodGoals::blocks};
    for (const auto step : kSteps) {
        if (const Done done = (this->*step)(); !done) return tl::unexpected(done.error());
    }
    return std::move(figures_);
}

}  // namespace eyepoint::tools
