/// eyepoint-bench compare: whether a flight became better or worse.
#include <cstdlib>
#include <memory>

#include <fmt/format.h>

#include "tools/bench/command_options.hpp"
#include "tools/bench/regression/bands.hpp"
#include "tools/bench/regression/comparison.hpp"
#include "tools/bench/regression/picture_comparison.hpp"
#include "tools/report/page.hpp"

namespace eyepoint::tools {

namespace {

constexpr int kNotComparable = 2;

struct CompareRequest {
    std::filesystem::path before, after;
    std::filesystem::path bands;
    std::vector<std::filesystem::path> pictures;
    std::filesystem::path json;
    ComparisonOptions options;
    bool exact = false;
};

[[noreturn]] void not_comparable(const std::string& sentence) {
    fmt::print(stderr, "eyepoint-bench: {}\n", sentence);
    std::exit(kNotComparable);
}

template <typename Value>
Value value_of(tl::expected<Value, std::string> got) {
    if (!got) not_comparable(got.error());
    return std::move(*got);
}

void run(const CompareRequest& request) {
    const FlightResult before = value_of(read_flight_result(request.before));
    const FlightResult after = value_of(read_flight_result(request.after));
    Comparison comparison = value_of(compare(before, after, request.options));
    if (!request.bands.empty()) {
        for (ComparedLine& line : judge(after, value_of(read_bands(request.bands))))
            comparison.lines.push_back(std::move(line));
    }
    if (!request.pictures.empty())
        comparison.lines.push_back(
            value_of(compare_picture_folders(request.pictures[0], request.pictures[1])));
    fmt::print("{}", describe(comparison));
    if (!request.json.empty())
        if (auto written = write_whole(request.json, to_json_text(comparison)); !written)
            not_comparable(written.error());
    if (!comparison.passes(request.exact)) std::exit(EXIT_FAILURE);
}

}  // namespace

void add_compare_command(CLI::App& program) {
    auto request = std::make_shared<CompareRequest>();
    auto* command = program.add_subcommand(
        "compare",
        "Says what became better or worse from one flight's result to another's; exit code 0: nothing "
        "is worse or looks different, 1: something is, 2: they cannot be compared.");
    command->add_option("before", request->before, "result of eyepoint-bench flight --json")->required();
    command->add_option("after", request->after, "the result to judge")->required();
    command
        ->add_option("--margin", request->options.margin,
                     "change of a ratio or time that does not matter, share")
        ->check(CLI::Range(0.0, 1.0))
        ->capture_default_str();
    command->add_flag("--exact", request->exact, "a count that became better fails too");
    command->add_option("--bands", request->bands, "JSON file of what the ratios of AFTER may be")
        ->type_name("FILE");
    command
        ->add_option("--pictures", request->pictures,
                     "both flights' folders of pictures, where OpenGL differs")
        ->expected(2)
        ->type_name("DIR DIR");
    command->add_option("--json", request->json, "write the comparison there")->type_name("FILE");
    command->callback([request] { run(*request); });
    command->footer("Example: eyepoint-bench compare before.json after.json");
}

}  // namespace eyepoint::tools
