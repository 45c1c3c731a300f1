#include "tools/bench/goals/selective_goals.hpp"

#include <sstream>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "terrain/block/block.hpp"
#include "tools/bench/goals/callgrind_profile.hpp"
#include "tools/bench/goals/profiled_flight.hpp"

namespace eyepoint::tools {

namespace {

using terrain::selective::ErrorFormula;
using terrain::selective::ReuseTest;

constexpr double kSelectiveTauPx = 1.0, kSelectiveSlackPx = 0.1;
/// Of the paper's figures at this tolerance and slack.
constexpr double kMostPercentOfUncached = 4.0, kMostTrianglesLostPercent = 4.5, kMostMissedPercent = 1.7;

double percent(double part, double whole) { return 100.0 * part / whole; }

tl::expected<FlightFigures, std::string> fly_selective(GoalBench& bench, ReuseTest reuse) {
    FlightOptions flight{.lod_method = "selective", .selective = {ErrorFormula::Paper, reuse}};
    return bench.fly_anew(bench.paths().cruise, flight, kSelectiveTauPx,
                          reuse == ReuseTest::Off ? 0.0 : kSelectiveSlackPx,
                          {.posts = false, .pops = false, .faults = false});
}

/// Instructions of generation, and what it was done for.
struct Generated {
    double instructions = 0.0, frames = 0.0, blocks_anew = 0.0;
    [[nodiscard]] double a_frame() const { return instructions / frames; }
};

tl::expected<Generated, std::string> generate(const GoalBench& bench, const std::string& cache) {
    constexpr std::size_t kFrames = 60;
    const auto flown = profile_selection(
        bench, kFrames,
        {"--lod", "selective", "--screen-error", "paper", "--cache", cache, "--tau",
         fmt::format("{}", kSelectiveTauPx), "--slack", fmt::format("{}", kSelectiveSlackPx)});
    if (!flown) return tl::unexpected(flown.error());
    std::istringstream profile(flown->profile);
    Generated generated;
    generated.instructions =
        static_cast<double>(instructions_of_calls(profile, "SelectiveLod::select_vertices("));
    if (generated.instructions == 0.0)
        return tl::unexpected(std::string("valgrind does not find generation by its name"));
    generated.frames = static_cast<double>(flown->frames.size());
    for (const auto& frame : flown->frames) generated.blocks_anew += frame["blocks_chosen"].get<double>();
    return generated;
}

tl::expected<GenerationInstructions, std::string> count_generation(const GoalBench& bench) {
    const auto uncached = generate(bench, "off");
    if (!uncached) return tl::unexpected(uncached.error());
    const auto four_corner = generate(bench, "four_corner");
    if (!four_corner) return tl::unexpected(four_corner.error());
    const auto sound = generate(bench, "sound");
    if (!sound) return tl::unexpected(sound.error());
    return GenerationInstructions{
        uncached->a_frame(), four_corner->a_frame(), sound->a_frame(),
        uncached->instructions / (uncached->blocks_anew * static_cast<double>(terrain::kBlockVertices))};
}

}  // namespace

std::vector<GoalLine> selective_goals(const SelectiveFlights& flights) {
    std::vector<GoalLine> lines;
    const auto add = [&](const std::string& test, const FlightFigures& cached) {
        const FlightFigures& uncached = flights.uncached;
        lines.push_back(at_most(
            16, "selective, whole selection's CPU of uncached, " + test + ", cruise, s 0.1 px",
            percent(cached.selection_us_mean, uncached.selection_us_mean), kMostPercentOfUncached, "%"));
        lines.push_back(at_least(16, "selective, triangles against uncached, " + test + ", likewise",
                                 percent(cached.triangles_mean, uncached.triangles_mean) - 100.0,
                                 -kMostTrianglesLostPercent, "%"));
    };
    add("four corners", flights.four_corner);
    add("sound test", flights.sound);
    const terrain::SelectionAudit& audit = flights.four_corner.audit;
    lines.push_back(at_most(16, "selective, vertices missed, four corners, likewise",
                            percent(static_cast<double>(audit.missed), static_cast<double>(audit.selected)),
                            kMostMissedPercent, "%"));
    lines.push_back(at_most(16, "selective, vertices beyond tau + s, sound test, likewise",
                            static_cast<double>(flights.sound.audit.too_far), 0.0));
    return lines;
}

std::vector<GoalLine> generation_goals(const std::optional<GenerationInstructions>& instructions) {
    const auto of_uncached = [&](double GenerationInstructions::*cached) {
        return instructions ? std::optional{percent((*instructions).*cached, instructions->uncached)}
                            : std::nullopt;
    };
    const std::string what = "selective, instructions of generation, of uncached, ";
    return {at_most(16, what + "four corners, likewise", of_uncached(&GenerationInstructions::four_corner),
                    kMostPercentOfUncached, "%"),
            at_most(16, what + "sound test, likewise", of_uncached(&GenerationInstructions::sound),
                    kMostPercentOfUncached, "%"),
            at_most(16, "selective, instructions a block post of a rebuild",
                    instructions ? std::optional{instructions->a_rebuilt_post} : std::nullopt, 40.0)};
}

GoalDone measure_selective(GoalBench& bench, GoalReport& report) {
    const auto uncached = fly_selective(bench, ReuseTest::Off);
    if (!uncached) return tl::unexpected(uncached.error());
    const auto four_corner = fly_selective(bench, ReuseTest::FourCorner);
    if (!four_corner) return tl::unexpected(four_corner.error());
    const auto sound = fly_selective(bench, ReuseTest::Sound);
    if (!sound) return tl::unexpected(sound.error());
    for (GoalLine& line : selective_goals({*uncached, *four_corner, *sound})) report.add(std::move(line));
    report.note(fmt::format(
        "Goal 16: tau 1 px, screen error of the paper, selection with cut and dikes; {:.0f} triangles and "
        "{:.2f} ms of selection uncached, {:.0f} "
        "and "
        "{:.2f} with four corners, {:.0f} and {:.2f} with the sound test (means).",
        uncached->triangles_mean, uncached->selection_us_mean * 1e-3, four_corner->triangles_mean,
        four_corner->selection_us_mean * 1e-3, sound->triangles_mean, sound->selection_us_mean * 1e-3));
    return {};
}

GoalDone measure_generation(GoalBench& bench, GoalReport& report) {
    const auto counted = count_generation(bench);
    for (GoalLine& line : generation_goals(counted ? std::optional{*counted} : std::nullopt))
        report.add(std::move(line));
    report.note(counted ? fmt::format("Generation, instructions a frame: {:.0f} uncached, {:.0f} with four "
                                      "corners, {:.0f} with the sound test.",
                                      counted->uncached, counted->four_corner, counted->sound)
                        : "Instructions of generation are not measured: " + counted.error() + ".");
    return {};
}

}  // namespace eyepoint::tools
