/// eyepoint-bench flight: a recorded flight, drawn as fast as it goes.
#include <memory>

#include <fmt/format.h>

#include "config/settings.hpp"
#include "tools/bench/command_options.hpp"
#include "tools/bench/eyes.hpp"

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
};

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
    const auto result = run_bench(options, *eyes);
    if (!result) fail(result.error());
    fmt::print("{}", describe(*result));
}

}  // namespace

void add_flight_command(CLI::App& program) {
    auto request = std::make_shared<FlightRequest>();
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
    command->callback([request] { run(*request); });
    command->footer(
        "Example: eyepoint-bench flight tools/flights/goms-c172-60s-30hz.pcap --terrain out/demo/terrain");
}

}  // namespace eyepoint::tools
