/// eyepoint-bench goals: everything that Eyepoint is to reach, met or missed.
#include <array>
#include <cstdlib>
#include <memory>
#include <vector>

#include <fmt/format.h>

#include "tools/bench/allocation_count.hpp"
#include "tools/bench/command_options.hpp"
#include "tools/bench/goals/bintree_goals.hpp"
#include "tools/bench/goals/block_goals.hpp"
#include "tools/bench/goals/control_goals.hpp"
#include "tools/bench/goals/culling_goals.hpp"
#include "tools/bench/goals/default_goals.hpp"
#include "tools/bench/goals/drawing_goals.hpp"
#include "tools/bench/goals/frame_goals.hpp"
#include "tools/bench/goals/hyperblock_goals.hpp"
#include "tools/bench/goals/mesh_goals.hpp"
#include "tools/bench/goals/program_goals.hpp"
#include "tools/bench/goals/selection_goals.hpp"
#include "tools/bench/goals/selective_goals.hpp"
#include "tools/report/page.hpp"

namespace eyepoint::tools {

namespace {

struct GoalsRequest {
    GoalSettings settings;
    std::string only;
    bool json = false;
    std::filesystem::path page;
};

/// A measurement and the goals that it has lines of.
struct Step {
    std::vector<int> goals;
    const char* doing;
    GoalDone (*measure)(GoalBench&, GoalReport&);
};

const std::array kSteps{
    Step{{1}, "matching tolerances to the field's measure of comparison", measure_triangles},
    Step{{2}, "comparing meshes with all posts at twelve tolerances", measure_post_error},
    Step{{3}, "drawing cruise by turns with tile", measure_against_tile},
    Step{{4, 7}, "selecting along cruise at five tolerances", measure_selection},
    Step{{4}, "counting instructions of selection with valgrind", measure_instructions},
    Step{{5}, "comparing consecutive meshes", measure_jumps},
    Step{{5}, "drawing cruise by turns with morph and without", measure_morph},
    Step{{6}, "unfolding tiles", measure_blocks},
    Step{{6}, "making all meshes anew", measure_compiler},
    Step{{8}, "drawing cruise and its floor by turns", measure_against_floor},
    Step{{9}, "counting what horizon culling leaves out", measure_hidden},
    Step{{9}, "drawing cruise by turns with horizon culling and without", measure_culled_frames},
    Step{{9}, "timing horizon culling where it hides nothing", measure_idle_culling},
    Step{{10, 11, 12}, "drawing a flight, and every fifth frame as a static mesh", measure_frames},
    Step{{13}, "running eyepoint with an eye that stands still", measure_idle},
    Step{{14}, "flying sweep under tolerance control, four times", measure_control},
    Step{{15}, "running eyepoint at 60 Hz", measure_delay},
    Step{{16}, "selecting along cruise by selective, with cache and without", measure_selective},
    Step{{16}, "counting instructions of selective with valgrind", measure_generation},
    Step{{17}, "drawing cruise by bintree while its blocks arrive", measure_bintree},
    Step{{18},
         "drawing cruise by turns by hyperblock and by its twin, selecting at five tolerances",
         measure_hyperblock},
    Step{{19}, "drawing cruise by turns by all methods at equal post error", measure_default},
};

GoalChoice chosen_by(const GoalsRequest& request) {
    if (request.only.empty()) return {};
    const auto chosen = GoalChoice::parse(request.only);
    if (!chosen) fail("--only: " + chosen.error());
    return *chosen;
}

void print_line(const GoalLine& line) {
    fmt::print("{}\n", describe(line));
    std::fflush(stdout);
}

void measure(GoalBench& bench, const GoalChoice& chosen, GoalReport& report) {
    for (const Step& step : kSteps) {
        if (!chosen.has_any(step.goals)) continue;
        fmt::print(stderr, "{} ...\n", step.doing);
        if (const GoalDone done = step.measure(bench, report); !done) fail(done.error());
    }
}

void run(const GoalsRequest& request) {
    const GoalChoice chosen = chosen_by(request);
    GoalSettings settings = request.settings;
    settings.programs = std::filesystem::read_symlink("/proc/self/exe").parent_path();
    settings.allocations = heap_allocations;
    const std::string machine = describe_machine();
    auto bench = GoalBench::open(std::move(settings));
    if (!bench) fail(bench.error());
    GoalReport report(chosen, request.json ? std::function<void(const GoalLine&)>{} : print_line);
    measure(*bench, chosen, report);
    if (request.json) fmt::print("{}\n", to_json(report.lines(), machine, report.notes()).dump(2));
    if (!request.json)
        for (const std::string& note : report.notes()) fmt::print("{}\n", note);
    if (!request.page.empty()) write_or_fail(request.page, markdown(report.lines(), machine, report.notes()));
    if (any_missed(report.lines())) std::exit(EXIT_FAILURE);
}

std::string goals_by_number() {
    std::string text = "Goals:\n";
    for (const GoalSubject& goal : kGoalSubjects)
        text += fmt::format("  {:>2}  {}\n", goal.number, goal.what);
    return text;
}

void add_options(CLI::App& command, GoalsRequest& request) {
    GoalSettings& settings = request.settings;
    command.add_option("--terrain", settings.terrain, "the benchmark field's database")
        ->type_name("DB")
        ->required();
    command.add_option("--paths", settings.paths, "folder of cruise.csv and sweep.csv")
        ->check(CLI::ExistingDirectory)
        ->type_name("DIR")
        ->required();
    auto* flight = command
                       .add_option("--flight", settings.flight,
                                   "recorded flight for goals 10 to 12 (pcap); otherwise cruise is flown")
                       ->type_name("FILE");
    auto* flight_terrain =
        command.add_option("--flight-terrain", settings.flight_terrain, "database that it is flown over")
            ->type_name("DB");
    flight->needs(flight_terrain);
    command.add_option("--only", request.only, "only these goals, by number: 3,8")->type_name("GOALS");
    command.add_option("--lod", settings.lod_method, "level-of-detail method")->capture_default_str();
    command
        .add_option("--every", settings.every,
                    "compare the mesh with all posts, and draw by turns, every so-manieth frame")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    command.add_flag("--json", request.json, "print JSON, at the end, instead of lines");
    command.add_option("--page", request.page, "page to write (Markdown)")->type_name("FILE");
}

}  // namespace

void add_goals_command(CLI::App& program) {
    auto request = std::make_shared<GoalsRequest>();
    auto* command = program.add_subcommand(
        "goals", "Measures Eyepoint against its goals, a line each; exit code 1 when one is missed.");
    add_options(*command, *request);
    command->callback([request] { run(*request); });
    command->footer(goals_by_number() +
                    "Example: eyepoint-bench goals --terrain FIELD --paths $EYEPOINT_REAL_DATA/benchmark\n"
                    "           --flight tools/flights/goms-c172-60s-30hz.pcap --flight-terrain sample.db");
}

}  // namespace eyepoint::tools
