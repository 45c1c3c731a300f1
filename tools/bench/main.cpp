/// eyepoint-bench: what drawing costs, in numbers that can be compared.
#include <cstdlib>
#include <map>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "tools/bench/command_options.hpp"
#include "tools/report/page.hpp"

namespace eyepoint::tools {

void fail(const std::string& sentence) {
    fmt::print(stderr, "eyepoint-bench: {}\n", sentence);
    std::exit(EXIT_FAILURE);
}

void write_or_fail(const std::filesystem::path& file, const std::string& text) {
    if (auto written = write_whole(file, text); !written) fail(written.error());
}

void add_size_option(CLI::App& command, ig::PictureSize& size) {
    command
        .add_option_function<std::string>(
            "--size",
            [&size](const std::string& text) {
                int width = 0, height = 0;
                char rest = 0;
                if (std::sscanf(text.c_str(), "%dx%d%c", &width, &height, &rest) != 2 || width < 16 ||
                    height < 16) {
                    throw CLI::ValidationError("--size", "'" + text + "' is no size; write it as 1280x720");
                }
                size = {width, height};
            },
            "picture, WIDTHxHEIGHT pixels")
        ->default_str(fmt::format("{}x{}", size.width_px, size.height_px));
}

void add_selective_options(CLI::App& command, terrain::selective::Options& options) {
    using terrain::selective::ErrorFormula, terrain::selective::ReuseTest;
    static const std::map<std::string, ReuseTest> tests{
        {"sound", ReuseTest::Sound}, {"four_corner", ReuseTest::FourCorner}, {"off", ReuseTest::Off}};
    static const std::map<std::string, ErrorFormula> formulas{{"bound", ErrorFormula::Bound},
                                                              {"paper", ErrorFormula::Paper}};
    command
        .add_option("--cache", options.reuse,
                    "selective alone: the test by which a block's vertices are used again")
        ->transform(CLI::CheckedTransformer(tests))
        ->option_text("sound|four_corner|off");
    command.add_option("--screen-error", options.error, "selective alone: what a vertex is judged by")
        ->transform(CLI::CheckedTransformer(formulas))
        ->option_text("bound|paper");
}

void add_tile_options(CLI::App& command, terrain::tiles::Options& options) {
    using terrain::tiles::MorphClock;
    static const std::map<std::string, MorphClock> clocks{
        {"distance", MorphClock::Distance}, {"time", MorphClock::Time}, {"frames", MorphClock::Frames}};
    command.add_option("--tile-posts", options.posts, "tile alone: posts of a tile, a side")
        ->check(CLI::IsMember({9, 17, 33}))
        ->capture_default_str();
    command.add_option("--morph-by", options.clock, "tile alone: what moves a morph on")
        ->transform(CLI::CheckedTransformer(clocks))
        ->option_text("distance|time|frames");
    command
        .add_option("--rebuilds", options.rebuilds,
                    "tile alone: tiles that may change to another level's mesh in a frame")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
}

void add_hyperblock_options(CLI::App& command, terrain::hyperblock::Options& options) {
    using terrain::hyperblock::SelectBy;
    static const std::map<std::string, SelectBy> selects{{"block", SelectBy::Block},
                                                         {"vertex", SelectBy::Vertex}};
    command.add_option("--hyper-select", options.select_by, "hyperblock alone: what is selected")
        ->transform(CLI::CheckedTransformer(selects))
        ->option_text("block|vertex");
    command
        .add_option("--hyper-level", options.hyper_level,
                    "hyperblock alone: how often a tile is halved to get blocks")
        ->check(CLI::Range(0, terrain::hyperblock::kMostHyperLevel))
        ->capture_default_str();
    command
        .add_option("--hyper-blocks-tau", options.blocks_tau_px,
                    "hyperblock alone: tolerance that tiles are chosen for, pixels; 0: --tau")
        ->check(CLI::Range(0.0, 100.0))
        ->capture_default_str();
}

void add_drawing_options(CLI::App& command, BenchOptions& options, bool terrain_required) {
    auto* terrain = command.add_option("--terrain", options.terrain, "terrain database")->type_name("DB");
    if (terrain_required) terrain->required();
    add_size_option(command, options.size);
    command.add_option("--tau", options.scene.tau_px, "tolerance, pixels")
        ->check(CLI::Range(0.05, 100.0))
        ->capture_default_str();
    command.add_option("--lod", options.scene.lod_method, "level-of-detail method")->capture_default_str();
    command.add_option("--triangles", options.scene.triangle_budget,
                       "bintree alone: triangles a frame at most; 0: no limit");
    add_selective_options(command, options.scene.selective);
    add_tile_options(command, options.scene.tile);
    add_hyperblock_options(command, options.scene.hyperblock);
    command.add_option("--visibility", options.scene.visibility_m, "metres")->capture_default_str();
    command.add_option("--pictures", options.pictures, "folder for pictures")->type_name("DIR");
    command.add_option("--every", options.picture_every, "a picture every so many frames")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    command.add_option("--record", options.record, "frame record to write (JSON lines)")->type_name("FILE");
    command.add_flag("--sentinel", options.scene.sentinel, "no sky: magenta where no terrain is drawn");
}

}  // namespace eyepoint::tools

int main(int argc, char** argv) {
    CLI::App program{"Measures Eyepoint: frames, selection, triangles, memory; in virtual time, off screen."};
    program.set_version_flag("--version", EYEPOINT_VERSION);
    program.require_subcommand(1);
    eyepoint::tools::add_flight_command(program);
    eyepoint::tools::add_field_command(program);
    eyepoint::tools::add_measure_command(program);
    eyepoint::tools::add_goals_command(program);
    eyepoint::tools::add_compare_command(program);
    eyepoint::tools::add_control_command(program);
    eyepoint::tools::add_papers_command(program);
    CLI11_PARSE(program, argc, argv);
    return EXIT_SUCCESS;
}
