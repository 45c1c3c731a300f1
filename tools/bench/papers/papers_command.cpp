/// eyepoint-bench papers: the experiments of published papers, on Eyepoint's own methods.
#include <array>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <memory>

#include <fmt/format.h>

#include "tools/bench/command_options.hpp"
#include "tools/bench/goals/goal_line.hpp"
#include "tools/bench/papers/he_wang_liu.hpp"
#include "tools/bench/papers/hyperblock_quadtin.hpp"
#include "tools/bench/papers/larsen_christensen.hpp"
#include "tools/bench/papers/paper_plots.hpp"
#include "tools/bench/papers/ueng_chuang.hpp"
#include "tools/report/page.hpp"

namespace eyepoint::tools {

namespace {

struct Named {
    const char* doing;
    PaperExperiment experiment;
};
constexpr std::array kExperiments{Named{"Ueng & Chuang, tables 1 to 3", ueng_chuang_tables_1_to_3},
                                  Named{"He, Wang & Liu, table 1", he_wang_liu_table_1},
                                  Named{"Larsen & Christensen, table 7", larsen_christensen_table_7},
                                  Named{"HyperBlock-QuadTIN, figures 14 to 16", hyperblock_figures_14_to_16}};

struct PapersRequest {
    PaperSettings settings;
    std::filesystem::path from;
    std::filesystem::path results;
    std::string only;  ///< part of an experiment's name; empty: all
};

PaperResults read_results(const std::filesystem::path& file) {
    std::ifstream stream(file);
    auto results = parse_paper_results({std::istreambuf_iterator<char>(stream), {}});
    if (!results) fail(file.string() + ": " + results.error());
    return *std::move(results);
}

PaperResults run_experiments(PapersRequest request) {
    if (request.settings.synth_field.empty()) fail("--synth-field is needed, or --from");
    request.settings.programs = std::filesystem::read_symlink("/proc/self/exe").parent_path();
    const char* real_data = std::getenv("EYEPOINT_REAL_DATA");
    if (request.settings.benchmark.empty() && real_data != nullptr)
        request.settings.benchmark = std::filesystem::path(real_data) / "benchmark";
    PaperResults results{describe_machine(), {}};
    for (const Named& named : kExperiments) {
        if (std::string_view{named.doing}.find(request.only) == std::string_view::npos) continue;
        fmt::print(stderr, "{} ...\n", named.doing);
        auto table = named.experiment(request.settings);
        if (!table) fail(table.error());
        results.tables.push_back(std::move(*table));
    }
    if (results.tables.empty()) fail("--only " + request.only + ": no experiment has this in its name");
    return results;
}

void run(const PapersRequest& request) {
    const PaperResults results = request.from.empty() ? run_experiments(request) : read_results(request.from);
    const std::string page = markdown(results.tables, results.machine);
    fmt::print("{}", page);
    if (request.results.empty()) return;
    write_or_fail(request.results / "papers.md", page);
    write_or_fail(request.results / "papers.json", to_json(results.tables, results.machine).dump(2) + "\n");
    write_or_fail(request.results / "papers.html", plots_page(results));
}

}  // namespace

void add_papers_command(CLI::App& program) {
    auto request = std::make_shared<PapersRequest>();
    auto* command = program.add_subcommand(
        "papers", "Runs the experiments of published papers again: their figures beside ours.");
    command->add_option("--synth-field", request->settings.synth_field, "synthetic field's database")
        ->type_name("DB");
    command->add_option("--from", request->from, "papers.json of an earlier run: only make its pages anew")
        ->check(CLI::ExistingFile)
        ->type_name("FILE");
    command
        ->add_option("--benchmark", request->settings.benchmark,
                     "folder of the benchmark field; else benchmark/ in what EYEPOINT_REAL_DATA names")
        ->check(CLI::ExistingDirectory)
        ->type_name("DIR");
    command->add_option("--only", request->only, "only experiments with this in their names")
        ->type_name("TEXT");
    command
        ->add_option("--cut-field", request->settings.cut_field,
                     "database of a cut of 2049 x 2049 posts; without it the synthetic field stands in")
        ->type_name("DB");
    command->add_option("--seconds", request->settings.seconds, "of each flight")
        ->check(CLI::Range(1.0, 600.0))
        ->capture_default_str();
    command->add_option("--every", request->settings.every, "measure post error every so-manieth frame")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    command
        ->add_option("-o,--output", request->results,
                     "folder for papers.md, papers.json and papers.html (plots)")
        ->check(CLI::ExistingDirectory)
        ->type_name("DIR");
    command->callback([request] { run(*request); });
    command->footer(
        "Make the field once, then measure:\n"
        "  eyepoint-terrain synth --benchmark-field 16385 -o FIELD\n"
        "  eyepoint-terrain synth --benchmark-field 2049 -o CUT\n"
        "  eyepoint-bench papers --synth-field FIELD --cut-field CUT -o docs/results\n"
        "  eyepoint-bench papers --from docs/results/papers.json -o out");
}

}  // namespace eyepoint::tools
