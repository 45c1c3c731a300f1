#include "tools/bench/goals/hyperblock_goals.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "tools/bench/median.hpp"

namespace eyepoint::tools {

namespace {

using terrain::hyperblock::SelectBy;

constexpr const char* kHyperblock = "hyperblock";
constexpr std::array kTolerancesPx{0.25, 0.5, 1.0, 2.0, 4.0};

double selection_us(const SelectionAtTau& flight) { return flight.figures.selection_us_median; }

GoalDone measure_twin(GoalBench& bench, GoalReport& report) {
    std::vector scenes{goal_scene(kHyperblock, 1.0), goal_scene(kHyperblock, 1.0)};
    scenes.front().hyperblock.select_by = SelectBy::Vertex;
    const auto frames = draw_by_turns(
        bench.field(), scenes, every_nth(bench.paths().cruise, bench.settings().every), kGoalPicture, {});
    if (!frames) return tl::unexpected(frames.error());
    report.add(twin_goal({frames->front(), frames->back()}));
    const auto triangles = [](const TurnFrame& frame) { return static_cast<double>(frame.triangles); };
    report.note(fmt::format("Goal 18: {:.0f} triangles by block, {:.0f} by vertex (medians).",
                            median_of(frames->back(), triangles), median_of(frames->front(), triangles)));
    return {};
}

GoalDone measure_flatness(GoalBench& bench, GoalReport& report) {
    const FlightOptions flight{.lod_method = kHyperblock,
                               .hyperblock = {.blocks_tau_px = kTolerancesPx.front()}};
    std::vector<SelectionAtTau> flights;
    std::string by_tau;
    for (const double tau_px : kTolerancesPx) {
        const auto figures = bench.fly_anew(bench.paths().cruise, flight, tau_px, 0.0, kSelectionAlone);
        if (!figures) return tl::unexpected(figures.error());
        flights.push_back({tau_px, *figures});
        by_tau += fmt::format(" tau {}: {:.0f} us;", tau_px, selection_us(flights.back()));
    }
    report.add(flat_selection_goal(flights));
    report.note("Selection of hyperblock, median:" + by_tau);
    return {};
}

}  // namespace

GoalLine twin_goal(const DrawnPair& by_vertex_and_block) {
    return at_most(18, "hyperblock, frame CPU over that of its twin by vertex, cruise, tau 1 px",
                   frame_ratio(by_vertex_and_block), 0.75);
}

GoalLine flat_selection_goal(std::span<const SelectionAtTau> flights) {
    const auto [cheapest, dearest] = std::ranges::minmax_element(flights, {}, selection_us);
    return at_most(18, "hyperblock, selection, dearest tolerance over cheapest, 0.25 to 4 px",
                   selection_us(*dearest) / selection_us(*cheapest), 1.3);
}

GoalDone measure_hyperblock(GoalBench& bench, GoalReport& report) {
    if (auto done = measure_twin(bench, report); !done) return done;
    return measure_flatness(bench, report);
}

}  // namespace eyepoint::tools
