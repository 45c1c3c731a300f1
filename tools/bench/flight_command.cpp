/// eyepoint-bench flight: a recorded flight, drawn as fast as it goes.
#include <fstream>
#include <iterator>
#include <map>
#include <memory>

#include <fmt/format.h>
#include <xxhash.h>

#include "config/settings.hpp"
#include "tools/bench/allocation_count.hpp"
#include "tools/bench/command_options.hpp"
#include "tools/bench/eyes.hpp"
#include "tools/bench/goals/frame_goals.hpp"
#include "tools/bench/regression/bench_result_columns.hpp"
#include "tools/bench/regression/flight_page.hpp"
#include "tools/report/page.hpp"

namespace eyepoint::tools {

namespace {

struct FlightRequest {
    BenchOptions drawing;
    std::filesystem::path flight;
    double rate_hz = 30.0;
    double vertical_fov_deg = config::ViewSettings{}.vertical_fov_deg;
    bool ellipsoid = false;
    bool streaming = false;
    double from_s = 0.0;
    double until_s = 1e9;
    std::filesystem::path json, html;
    bool counts_only = false;
    bool goals = false;
};

std::string hash_of_file(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
    return fmt::format("{:016x}", XXH3_64bits(bytes.data(), bytes.size()));
}

FlightIdentity identity_of(const FlightRequest& request) {
    return {.program = EYEPOINT_VERSION,
            .machine = machine_name(),
            .gl = {},
            .flight = request.flight.filename().string(),
            .flight_hash = hash_of_file(request.flight),
            .terrain = {},
            .size = request.drawing.size,
            .rate_hz = request.rate_hz,
            .vertical_fov_deg = request.vertical_fov_deg,
            .tau_px = request.drawing.scene.tau_px,
            .lod_method = request.drawing.scene.lod_method,
            .shading = {},
            .streaming = request.streaming};
}

void keep(const FlightRequest& request, const BenchResult& bench) {
    FlightResult result = flight_result(bench, identity_of(request));
    if (request.goals)
        for (const GoalLine& line : frame_goals(result)) fmt::print("{}\n", describe(line));
    if (request.counts_only) result = counts_of(std::move(result));
    if (!request.json.empty()) write_or_fail(request.json, to_json_text(result));
    if (request.html.empty()) return;
    const auto page = flight_page(result);
    if (!page) fail(page.error());
    write_or_fail(request.html, *page);
}

void run(const FlightRequest& request) {
    const auto eyes = read_eyes({.file = request.flight,
                                 .size = request.drawing.size,
                                 .vertical_fov_deg = request.vertical_fov_deg,
                                 .rate_hz = request.rate_hz,
                                 .ellipsoid = request.ellipsoid,
                                 .from_s = request.from_s,
                                 .until_s = request.until_s});
    if (!eyes) fail(eyes.error());
    BenchOptions options = request.drawing;
    options.complete = !request.streaming;
    options.allocations = heap_allocations;
    options.hash_pictures = !request.json.empty();
    const auto result = run_bench(options, *eyes);
    if (!result) fail(result.error());
    fmt::print("{}", describe(*result));
    keep(request, *result);
}

void add_result_options(CLI::App& command, FlightRequest& request) {
    const std::map<std::string, ig::Shading> shadings{{"forward", ig::Shading::Forward},
                                                      {"deferred", ig::Shading::Deferred},
                                                      {"automatic", ig::Shading::Automatic}};
    request.drawing.scene.shading = ig::Shading::Deferred;
    command
        .add_option("--shading", request.drawing.scene.shading,
                    "forward, deferred (default), or automatic: the faster here, so that pictures of two "
                    "machines may "
                    "differ")
        ->transform(CLI::CheckedTransformer(shadings, CLI::ignore_case));
    command.add_option("--json", request.json, "result to write, for eyepoint-bench compare")
        ->type_name("FILE");
    command.add_option("--trace", request.drawing.trace, "trace of where the time goes, for ui.perfetto.dev")
        ->type_name("FILE");
    command.add_option("--html", request.html, "report to write")->type_name("FILE");
    command.add_flag("--goals", request.goals, "print what a frame may cost beside what it costs");
    command.add_flag("--counts-only", request.counts_only,
                     "write only what is the same in every run: no times, no machine");
    command
        .add_option("--still-every", request.drawing.still_every,
                    "draw every so-manieth frame's triangles as one static mesh too; 0: none")
        ->capture_default_str();
    command.add_option("--loader-threads", request.drawing.scene.loader_threads, "threads that load blocks")
        ->check(CLI::Range(1, 64))
        ->capture_default_str();
    command
        .add_option_function<std::uint64_t>(
            "--cache-mib",
            [&request](std::uint64_t mib) { request.drawing.scene.block_cache_bytes = mib << 20; },
            "memory for blocks that have been read, MiB")
        ->check(CLI::Range(16, 65536))
        ->default_str("512");
}

}  // namespace

void add_flight_command(CLI::App& program) {
    auto request = std::make_shared<FlightRequest>();
    constexpr std::uint64_t kStillEvery = 5;
    request->drawing.still_every = kStillEvery;
    auto* command =
        program.add_subcommand("flight", "Draws a recorded flight in virtual time and prints what it took.");
    command->add_option("flight", request->flight, "recorded flight (pcap)")
        ->required()
        ->check(CLI::ExistingFile);
    add_drawing_options(*command, request->drawing, true);
    command->add_option("--rate", request->rate_hz, "frames a second of flight")
        ->check(CLI::Range(0.01, 1000.0))
        ->capture_default_str();
    command->add_option("--fov", request->vertical_fov_deg, "vertical field of view, degrees")
        ->check(CLI::Range(1.0, 170.0))
        ->capture_default_str();
    command->add_option("--from", request->from_s, "start of the part to fly, seconds");
    command->add_option("--until", request->until_s, "end of the part to fly, seconds");
    command->add_flag("--ellipsoid", request->ellipsoid,
                      "the flight's altitudes are above the ellipsoid, not the sea");
    command->add_flag("--streaming", request->streaming, "do not wait for loads: draw what there is");
    add_result_options(*command, *request);
    command->callback([request] { run(*request); });
    command->footer(
        "Example: eyepoint-bench flight tools/flights/goms-c172-60s-30hz.pcap --terrain out/demo/terrain "
        "--json after.json --html after.html");
}

}  // namespace eyepoint::tools
