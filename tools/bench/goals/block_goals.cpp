#include "tools/bench/goals/block_goals.hpp"

#include <sys/resource.h>

#include <fmt/format.h>

#include "terrain/block/block.hpp"
#include "tools/bench/goals/scratch_folder.hpp"
#include "tools/process/child_process.hpp"

namespace eyepoint::tools {

namespace {

constexpr std::size_t kTiles = 500;
constexpr const char* kFieldDem = "rainier-refined-4097.tif";

/// CPU of all processes that this one has started and seen end.
double children_cpu_s() {
    rusage usage{};
    getrusage(RUSAGE_CHILDREN, &usage);
    const auto seconds = [](const timeval& time) {
        return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_usec) * 1e-6;
    };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

/// Millions of posts a minute and core, of a whole build.
tl::expected<double, std::string> build_field(const GoalBench& bench) {
    const GoalSettings& settings = bench.settings();
    const auto dem = settings.paths / kFieldDem;
    if (!std::filesystem::exists(dem)) return tl::unexpected(dem.string() + " is not there");
    const auto scratch = ScratchFolder::create();
    if (!scratch) return tl::unexpected(scratch.error());
    const double before_s = children_cpu_s();
    auto child = ChildProcess::start({(settings.programs / "eyepoint-terrain").string(), "build", "--dem",
                                      dem.string(), "--vertical", "ellipsoid", "--max-depth", "12", "-o",
                                      (scratch->path() / "field").string()});
    if (!child) return tl::unexpected(child.error());
    constexpr std::chrono::seconds kPatience{1200};
    const Ending ending = child->wait(kPatience);
    const double took_s = children_cpu_s() - before_s;
    if (ending.exit_code != 0)
        return tl::unexpected("eyepoint-terrain build failed: " + ending.standard_error);
    const auto field = terrain::Database::open(scratch->path() / "field");
    if (!field) return tl::unexpected(field.error());
    const double posts =
        static_cast<double>(field->tiles().size()) * terrain::kBlockCells * terrain::kBlockCells;
    return posts * 1e-6 * 60.0 / took_s;
}

}  // namespace

std::vector<GoalLine> block_goals(const UnfoldingTimes& times) {
    return {at_most(6, "unfolding a stored tile's nested mesh, CPU, median", times.median_ms, 0.3, "ms"),
            at_most(6, "nested meshes in the database, bits a post", times.mesh_bits_a_post, 8.0)};
}

GoalLine compiler_goal(std::optional<double> million_posts_a_minute) {
    return at_least(6, "whole build of the field to depth 12, million posts a minute and core",
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
    const auto speed = build_field(bench);
    report.add(compiler_goal(speed ? std::optional(*speed) : std::nullopt));
    if (!speed) report.note("The compiler is not measured: " + speed.error() + ".");
    return {};
}

}  // namespace eyepoint::tools
