#include "tools/bench/goals/selection_goals.hpp"

#include <algorithm>
#include <array>
#include <sstream>

#include <fmt/format.h>

#include "tools/bench/goals/callgrind_profile.hpp"
#include "tools/bench/goals/profiled_flight.hpp"

namespace eyepoint::tools {

namespace {

/// Of cruise, under callgrind: enough for blocks to change in them, few enough to load in a minute.
constexpr std::size_t kCountedFrames = 60;

/// Instructions and blocks of a flight's selections.
struct CountedFlight {
    std::uint64_t choosing = 0, cutting = 0;
    double blocks_tested = 0.0;
};

bool cuts(const std::string& function) {
    constexpr std::array kCutting{"CellCut::",   "cells_beyond",     "cells_within",
                                  "cells_below", "HorizonCulling::", "TerrainHorizon::"};
    return std::ranges::any_of(kCutting,
                               [&](const char* name) { return function.find(name) != std::string::npos; });
}

tl::expected<CountedFlight, std::string> count_instructions(const GoalBench& bench) {
    const auto flown = profile_selection(
        bench, kCountedFrames,
        {"--lod", bench.settings().lod_method, "--tau", "1", "--slack", fmt::format("{}", kSlackShare)});
    if (!flown) return tl::unexpected(flown.error());
    CountedFlight counted;
    std::istringstream profile(flown->profile);
    for (const auto& [function, instructions] : instructions_by_function(profile))
        (cuts(function) ? counted.cutting : counted.choosing) += instructions;
    if (counted.choosing == 0)
        return tl::unexpected(std::string("valgrind does not find selection by its name"));
    for (const auto& frame : flown->frames) counted.blocks_tested += frame["blocks_tested"].get<double>();
    return counted;
}

}  // namespace

std::vector<GoalLine> selection_goals(std::span<const SelectionAtTau> flights) {
    double least_ns = flights.front().figures.median_ns_per_block, most_ns = least_ns;
    std::uint64_t allocations = 0;
    for (const SelectionAtTau& flight : flights) {
        least_ns = std::min(least_ns, flight.figures.median_ns_per_block);
        most_ns = std::max(most_ns, flight.figures.median_ns_per_block);
        allocations += flight.figures.allocations;
    }
    constexpr double kBlocks = 400.0;
    const FlightFigures& one = std::ranges::find(flights, 1.0, &SelectionAtTau::tau_px)->figures;
    return {at_most(4, "selection, CPU a block tested, cruise, tau 1 px, s 0.1 tau (median)",
                    one.median_ns_per_block, 10.0, "ns"),
            at_most(4, "selection, CPU for 400 blocks drawn, likewise",
                    one.selection_us_median / one.blocks_drawn_mean * kBlocks, 20.0, "us"),
            at_least(4, "block evaluations avoided, likewise", 100.0 * one.reused_share, 99.0, "%"),
            at_most(4, "dearest tolerance over cheapest, CPU a block tested, tau 0.25 to 4 px",
                    most_ns / least_ns, 1.3),
            at_most(7, "heap allocations in selection, cruise at five tolerances",
                    static_cast<double>(allocations), 0.0)};
}

GoalLine instructions_goal(std::optional<double> instructions_a_block) {
    return at_most(4, "choosing, cuts into cells left out, instructions a block tested, likewise",
                   instructions_a_block, 60.0);
}

GoalDone measure_selection(GoalBench& bench, GoalReport& report) {
    std::vector<SelectionAtTau> flights;
    std::string by_tau;
    for (const double tau_px : {0.25, 0.5, 1.0, 2.0, 4.0}) {
        const auto figures = bench.fly(bench.paths().cruise,
                                       {bench.settings().lod_method, tau_px, kSlackShare}, kSelectionAlone);
        if (!figures) return tl::unexpected(figures.error());
        by_tau +=
            fmt::format(" tau {}: {:.1f} us a frame, {:.0f} blocks tested, {:.0f} drawn, {:.1f} ns each;",
                        tau_px, figures->selection_us_median, figures->tested_mean,
                        figures->blocks_drawn_mean, figures->median_ns_per_block);
        flights.push_back({tau_px, *figures});
    }
    for (GoalLine& line : selection_goals(flights)) report.add(std::move(line));
    report.note("Selection:" + by_tau);
    return {};
}

GoalDone measure_instructions(GoalBench& bench, GoalReport& report) {
    if (!report.wants(4)) return {};
    const auto counted = count_instructions(bench);
    if (!counted) {
        report.add(instructions_goal(std::nullopt));
        report.note("Instructions are not measured: " + counted.error() + ".");
        return {};
    }
    const double choosing = static_cast<double>(counted->choosing) / counted->blocks_tested;
    report.add(instructions_goal(choosing));
    report.note(
        fmt::format("Instructions a block tested: {:.0f} to choose, {:.0f} to cut what is drawn into "
                    "cells.",
                    choosing, static_cast<double>(counted->cutting) / counted->blocks_tested));
    return {};
}

}  // namespace eyepoint::tools
