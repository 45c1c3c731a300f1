#include "tools/bench/goals/program_goals.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <sstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "tools/bench/goals/hosted_program.hpp"
#include "tools/bench/goals/scratch_folder.hpp"

namespace eyepoint::tools {

namespace {

constexpr double kPacketsHz = 60.0;
/// Small, so that a software renderer holds the rate: what is measured is the way through the program.
constexpr const char* kSmallPicture = "160x120";

std::filesystem::path program_of(const GoalBench& bench) { return bench.settings().programs / "eyepoint"; }

std::vector<terrain::Geodetic> places_of(const std::vector<ig::FlightEye>& eyes) {
    std::vector<terrain::Geodetic> places;
    for (const ig::FlightEye& eye : eyes) places.push_back(eye.eyepoint.place);
    return places;
}

double nearest_rank(std::vector<double> values, double share) {
    std::ranges::sort(values);
    const double rank = std::max(std::ceil(share * static_cast<double>(values.size())), 1.0);
    return values[static_cast<std::size_t>(rank) - 1];
}

tl::expected<double, std::string> idle_cpu_percent(const GoalBench& bench) {
    constexpr double kRateHz = 30.0, kMeasuredS = 10.0;
    const terrain::Geodetic still = bench.paths().cruise.front().eyepoint.place;
    auto program =
        HostedProgram::start(program_of(bench), bench.settings().terrain,
                             {"--rate", "60", "--size", "800x800", "--set", "frame.draw=on_change"});
    if (!program) return tl::unexpected(program.error());
    const auto stand = [&](double for_s) {
        return program->fly(std::vector(static_cast<std::size_t>(for_s * kRateHz), still), kRateHz);
    };
    // What it loads and draws first is not idling: until a second takes little.
    constexpr int kMostSettleS = 60;
    constexpr double kLittleS = 0.1;
    double before_s = 0.0;
    for (int second = 0; second < kMostSettleS && (second < 3 || program->cpu_s() - before_s > kLittleS);
         ++second) {
        before_s = program->cpu_s();
        if (auto stood = stand(1.0); !stood) return tl::unexpected(stood.error());
    }
    before_s = program->cpu_s();
    if (auto stood = stand(kMeasuredS); !stood) return tl::unexpected(stood.error());
    const double used_s = program->cpu_s() - before_s;
    if (auto ended = program->end(); !ended) return tl::unexpected(ended.error());
    return 100.0 * used_s / kMeasuredS;
}

tl::expected<std::vector<double>, std::string> fly_for_delays(const GoalBench& bench) {
    const auto scratch = ScratchFolder::create();
    if (!scratch) return tl::unexpected(scratch.error());
    const auto record = scratch->path() / "record.jsonl";
    auto program = HostedProgram::start(
        program_of(bench), bench.settings().terrain,
        {"--rate", fmt::format("{}", kPacketsHz), "--size", kSmallPicture, "--record", record.string()});
    if (!program) return tl::unexpected(program.error());
    if (auto flown = program->fly(places_of(bench.paths().cruise), kPacketsHz); !flown)
        return tl::unexpected(flown.error());
    if (auto ended = program->end(); !ended) return tl::unexpected(ended.error());
    std::ifstream stream(record);
    return delays_of_record({std::istreambuf_iterator<char>(stream), {}});
}

}  // namespace

GoalLine idle_goal(double cpu_percent) {
    return at_most(13, "CPU of a still eye drawn on change, of one core", cpu_percent, 2.0, "%");
}

GoalLine delay_goal(std::span<const double> delays_ms) {
    const auto p99_ms = delays_ms.empty()
                            ? std::nullopt
                            : std::optional(nearest_rank({delays_ms.begin(), delays_ms.end()}, 0.99));
    return at_most(15, fmt::format("transport delay at 60 Hz, p99, {} pixels", kSmallPicture), p99_ms,
                   2e3 / kPacketsHz + 1.0, "ms");
}

std::vector<double> delays_of_record(const std::string& lines) {
    std::vector<double> delays;
    std::istringstream stream(lines);
    for (std::string line; std::getline(stream, line);) {
        const auto frame = nlohmann::json::parse(line, nullptr, false);
        if (frame.is_object() && frame.value("new_packet", false))
            delays.push_back(frame["arrival_to_complete_ms"].get<double>());
    }
    return delays;
}

GoalDone measure_idle(GoalBench& bench, GoalReport& report) {
    const auto percent = idle_cpu_percent(bench);
    if (!percent) return tl::unexpected(percent.error());
    report.add(idle_goal(*percent));
    return {};
}

GoalDone measure_delay(GoalBench& bench, GoalReport& report) {
    const auto delays = fly_for_delays(bench);
    if (!delays) return tl::unexpected(delays.error());
    report.add(delay_goal(*delays));
    if (!delays->empty())
        report.note(fmt::format("Goal 15: {} packets drawn of {}; median {:.1f} ms, longest {:.1f} ms.",
                                delays->size(), bench.paths().cruise.size(), nearest_rank(*delays, 0.5),
                                nearest_rank(*delays, 1.0)));
    return {};
}

}  // namespace eyepoint::tools
