#include "tools/terrain/synth_command.hpp"

#include <memory>
#include <string>

#include <fmt/format.h>

#include "tools/terrain/command_failure.hpp"
#include "tools/terrain/compile.hpp"
#include "tools/terrain/interruption.hpp"
#include "tools/terrain/progress_bar.hpp"
#include "tools/terrain/synth_surface.hpp"

namespace eyepoint::tools {

namespace {

struct SynthOptions {
    SynthRequest request;
    std::string output;
    std::vector<double> centre;
    int benchmark_field = 0;
};

CompileRequest compile_request(const SynthOptions& options, const SynthSurface& surface,
                               const terrain::Geoid& geoid) {
    CompileRequest compile;
    compile.elevation = &surface;
    compile.geoid = &geoid;
    compile.output = options.output;
    compile.cancelled = was_interrupted;
    compile.manifest.name = fmt::format("Synthetic planet, seed {}", options.request.seed);
    compile.manifest.created_by = "eyepoint-terrain " EYEPOINT_VERSION;
    compile.manifest.detail_extent = surface.detail_extent();
    compile.manifest.sources.push_back(
        {fmt::format("seed {}", options.request.seed), "procedural", "EGM96",
         terrain::post_spacing_deg(depth_for_spacing(options.request.spacing_m)), 0});
    return compile;
}

void synthesise(SynthOptions options) {
    if (!options.centre.empty()) {
        options.request.centre_latitude_deg = options.centre[0];
        options.request.centre_longitude_deg = options.centre[1];
    }
    if (options.benchmark_field > 0) {
        if ((options.benchmark_field - 1) % terrain::kBlockCells != 0) {
            fail("synth", fmt::format("--benchmark-field {} is not 32 n + 1 posts; 16385 is",
                                      options.benchmark_field));
        }
        options.request.benchmark_field_posts = options.benchmark_field;
    }
    const auto geoid = terrain::Geoid::load(terrain::Geoid::default_grid());
    if (!geoid) fail("synth", geoid.error());
    watch_for_interruption();
    const auto surface = SynthSurface::make(options.request, *geoid, was_interrupted);
    if (!surface) fail("synth", "interrupted; nothing was written");
    auto compile = compile_request(options, *surface, *geoid);
    ProgressBar bar{"synth"};
    compile.progress = [&bar](std::uint64_t done, std::uint64_t total) { bar.show(done, total); };
    const auto manifest = compile_database(compile);
    if (!manifest) fail("synth", manifest.error());
    fmt::print("{}: {} tiles to depth {}\n", options.output, manifest->tiles, manifest->max_depth);
}

}  // namespace

void add_synth_command(CLI::App& application) {
    auto options = std::make_shared<SynthOptions>();
    auto* command = application.add_subcommand(
        "synth",
        "Makes a procedural planet with a mountain region; needs no data. Example: synth -o out/synth");
    command
        ->add_option("-o,--output", options->output, "Folder of the database; one there before is replaced")
        ->required();
    command->add_option("--seed", options->request.seed, "Another seed, another planet")
        ->capture_default_str();
    command->add_option("--centre", options->centre, "LAT,LON of the mountain region, degrees (46.45,8.25)")
        ->delimiter(',')
        ->expected(2);
    command->add_option("--size", options->request.size_deg, "Side of the ground in full detail, degrees")
        ->capture_default_str()
        ->check(CLI::Range(0.01, 20.0));
    command->add_option("--spacing", options->request.spacing_m, "Spacing of its posts, metres, at most")
        ->capture_default_str()
        ->check(CLI::Range(0.5, 20'000.0));
    command->add_option("--benchmark-field", options->benchmark_field,
                        "Full detail on a field of this many posts a side, such as 16385, instead of --size");
    command->callback([options] { synthesise(*options); });
}

}  // namespace eyepoint::tools
