/// eyepoint-bench field: the benchmark field that other terrain renderers were measured on.
#include <memory>

#include <fmt/format.h>

#include "tools/bench/command_options.hpp"
#include "tools/bench/planar_path.hpp"

namespace eyepoint::tools {

namespace {

struct FieldRequest {
    BenchOptions drawing;
    std::filesystem::path path;
    double vertical_fov_deg = 40.0;
    std::size_t first_frames = 0;
};

void run(const FieldRequest& request) {
    auto eyes = read_planar_path(request.path, kRainierField, request.drawing.size, request.vertical_fov_deg);
    if (!eyes) fail(eyes.error());
    if (request.first_frames > 0 && request.first_frames < eyes->size()) eyes->resize(request.first_frames);
    const auto result = run_bench(request.drawing, *eyes);
    if (!result) fail(result.error());
    fmt::print("{}", describe(*result));
}

}  // namespace

void add_field_command(CLI::App& program) {
    auto request = std::make_shared<FieldRequest>();
    request->drawing.size = {800, 800};
    auto* command = program.add_subcommand(
        "field",
        "Flies a path over the benchmark field (Mt Rainier, 4097 x 4097 posts) and prints what it took.");
    command->add_option("path", request->path, "cruise.csv or sweep.csv")
        ->required()
        ->check(CLI::ExistingFile);
    add_drawing_options(*command, request->drawing, true);
    command->add_option("--frames", request->first_frames, "only the first so many frames");
    command->callback([request] { run(*request); });
    command->footer(
        "Make the database once, then fly:\n"
        "  eyepoint-terrain build --dem rainier-refined-4097.tif --vertical ellipsoid --max-depth 15 -o "
        "FIELD\n"
        "  eyepoint-bench field cruise.csv --terrain FIELD --tau 1.3");
}

}  // namespace eyepoint::tools
