#include "tools/bench/goals/block_goals.hpp"

#include <fmt/format.h>

#include "ig/process_usage.hpp"
#include "terrain/block/block.hpp"
#include "tools/terrain/nest/nest.hpp"

namespace eyepoint::tools {

namespace {

constexpr std::size_t kTiles = 500;

double posts_of(const terrain::Database& database) {
    return static_cast<double>(database.tiles().size()) * terrain::kBlockCells * terrain::kBlockCells;
}

}  // namespace

std::vector<GoalLine> block_goals(const UnfoldingTimes& times) {
    return {at_most(6, "unfolding a stored tile's nested mesh, CPU, median", times.median_ms, 0.3, "ms"),
            at_most(6, "nested meshes in the database, bits a post", times.mesh_bits_a_post, 8.0)};
}

GoalLine compiler_goal(double million_posts_a_minute) {
    return at_least(6, "making the meshes of all tiles, million posts a minute and core",
                    million_posts_a_minute, 8.0);
}

GoalDone measure_blocks(GoalBench& bench, GoalReport& report) {
    const auto times = time_unfolding(*bench.field(), kTiles);
    if (!times) return tl::unexpected(times.error());
    for (GoalLine& line : block_goals(*times)) report.add(std::move(line));
    report.note(fmt::format(
        "Unfolding {} tiles: median {:.3f} ms, longest {:.3f} ms; reading and decoding {:.3f} ms.",
        times->tiles, times->median_ms, times->most_ms, times->read_median_ms));
    return {};
}

GoalDone measure_compiler(GoalBench& bench, GoalReport& report) {
    constexpr double kMsPerMinute = 6e4;
    const terrain::Database& field = *bench.field();
    const double start_ms = ig::process_cpu_ms();
    const auto made =
        make_nested_meshes(field, [](const NestedTile&) -> tl::expected<void, std::string> { return {}; });
    const double took_minutes = (ig::process_cpu_ms() - start_ms) / kMsPerMinute;
    if (!made) return tl::unexpected(made.error());
    report.add(compiler_goal(posts_of(field) * 1e-6 / took_minutes));
    return {};
}

}  // namespace eyepoint::tools
