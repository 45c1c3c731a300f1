#include "tools/bench/goals/bintree_goals.hpp"

#include <fmt/format.h>

#include "tools/bench/goals/streamed_flight.hpp"
#include "tools/bench/measure/node_bytes.hpp"

namespace eyepoint::tools {

std::vector<GoalLine> node_goals(const FlightFigures& flown) {
    constexpr double kMostBytes = 16.0;
    const auto bytes = [&](double of_block) {
        return bytes_a_node(flown.blocks_drawn_mean, flown.triangles_mean, of_block);
    };
    return {at_most(17, "bintree, bytes an active node, cruise, tau 1 px", bytes(kNodeSetsBytes), kMostBytes),
            at_most(17, "bintree, likewise, with what blocks know of all their posts",
                    bytes(kNodeSetsBytes + kNodeErrorsBytes), kMostBytes)};
}

std::vector<GoalLine> streaming_goals(const FlightResult& drawn) {
    return {at_most(17, "bintree, peak memory above a bare GL process, cruise", mib_above_bare(drawn), 256.0,
                    "MiB"),
            at_most(17, "bintree, frames that waited for data, cruise, 200 m/s",
                    static_cast<double>(frames_lacking_blocks(drawn)), 0.0)};
}

GoalDone measure_bintree(GoalBench& bench, GoalReport& report) {
    const auto flown = bench.fly(bench.paths().cruise, {.lod_method = "bintree"}, kSelectionAlone);
    if (!flown) return tl::unexpected(flown.error());
    for (GoalLine& line : node_goals(*flown)) report.add(std::move(line));
    const StreamedFlight flight{.programs = bench.settings().programs,
                                .flight = bench.settings().paths / "cruise.csv",
                                .terrain = bench.settings().terrain,
                                .size = kGoalPicture,
                                .lod_method = "bintree"};
    const auto drawn = draw_streamed(flight);
    if (!drawn) return tl::unexpected(drawn.error());
    for (GoalLine& line : streaming_goals(*drawn)) report.add(std::move(line));
    report.note(fmt::format(
        "Goal 17: {:.0f} triangles in {:.0f} blocks; drawn over {}, {} frames, {} MiB of blocks kept.",
        flown->triangles_mean, flown->blocks_drawn_mean, drawn->identity.terrain, drawn->frames,
        flight.block_cache_mib));
    return {};
}

}  // namespace eyepoint::tools
