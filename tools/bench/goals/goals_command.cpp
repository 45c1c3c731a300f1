/// eyepoint-bench goals: the level of detail's goals, met or missed.
#include <cstdlib>
#include <fstream>
#include <memory>

#include <fmt/format.h>

#include "ig/lod_view.hpp"
#include "terrain/geodesy/earth.hpp"
#include "tools/bench/allocation_count.hpp"
#include "tools/bench/command_options.hpp"
#include "tools/bench/eyes.hpp"
#include "tools/bench/goals/lod_goals.hpp"

namespace eyepoint::tools {

namespace {

struct GoalsRequest {
    std::filesystem::path terrain;
    std::filesystem::path paths;
    std::filesystem::path out;
    std::string lod_method = "nested";
    std::size_t every = 20;
};

/// The benchmark's path, so much lower.
std::vector<terrain::LodView> views_of(const std::filesystem::path& file, double lower_m = 0.0) {
    auto eyes = read_eyes({.file = file});
    if (!eyes) fail(eyes.error());
    std::vector<terrain::LodView> views;
    for (ig::FlightEye& eye : *eyes) {
        terrain::Geodetic& place = eye.eyepoint.place;
        place.height = terrain::EllipsoidalHeight{place.height.metres() - lower_m};
        eye.eyepoint.view.eye_ecef = terrain::to_ecef(place);
        views.push_back(ig::lod_view(eye.eyepoint.view, 1.0, 0.0));
    }
    return views;
}

void write(const std::filesystem::path& file, const std::string& text) {
    std::error_code ignored;
    std::filesystem::create_directories(file.parent_path(), ignored);
    std::ofstream stream(file);
    stream << text;
    if (!stream.flush()) fail(file.string() + ": cannot be written; check the folder and free space");
}

void run(const GoalsRequest& request) {
    constexpr double kLowerM = 700.0;
    auto field = terrain::Database::open(request.terrain);
    if (!field) fail(field.error());
    const std::string machine = describe_machine();
    LodGoals goals(std::make_shared<const terrain::Database>(std::move(*field)),
                   {views_of(request.paths / "cruise.csv"), views_of(request.paths / "sweep.csv"),
                    views_of(request.paths / "cruise.csv", kLowerM)},
                   {.lod_method = request.lod_method, .allocations = heap_allocations}, request.every);
    const auto figures = goals.measure([](const GoalLine& line) {
        fmt::print("{}\n", describe(line));
        std::fflush(stdout);
    });
    if (!figures) fail(figures.error());
    for (const std::string& note : figures->notes) fmt::print("{}\n", note);
    if (!request.out.empty()) {
        write(request.out / "goals.md", markdown(figures->lines, machine, figures->notes));
        write(request.out / "goals.json", to_json(figures->lines, machine, figures->notes).dump(2) + "\n");
    }
    for (const GoalLine& line : figures->lines)
        if (!line.met()) std::exit(EXIT_FAILURE);
}

}  // namespace

void add_goals_command(CLI::App& program) {
    auto request = std::make_shared<GoalsRequest>();
    auto* command = program.add_subcommand(
        "goals", "Measures the level of detail against its goals; exit code 1 when one is missed.");
    command->add_option("--terrain", request->terrain, "the benchmark field's database")
        ->type_name("DB")
        ->required();
    command->add_option("--paths", request->paths, "folder of cruise.csv and sweep.csv")
        ->check(CLI::ExistingDirectory)
        ->type_name("DIR")
        ->required();
    command->add_option("--lod", request->lod_method, "level-of-detail method")->capture_default_str();
    command->add_option("--every", request->every, "compare the mesh with all posts every so-manieth frame")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    command->add_option("--out", request->out, "folder for goals.md and goals.json")->type_name("DIR");
    command->callback([request] { run(*request); });
    command->footer(
        "Example: eyepoint-bench goals --terrain FIELD --paths $EYEPOINT_REAL_DATA/benchmark --out "
        "docs/results");
}

}  // namespace eyepoint::tools
