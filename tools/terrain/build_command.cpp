#include "tools/terrain/build_command.hpp"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "tools/terrain/build_command_report.hpp"
#include "tools/terrain/command_failure.hpp"
#include "tools/terrain/compile.hpp"
#include "tools/terrain/gdal_inputs.hpp"
#include "tools/terrain/imagery_mosaic.hpp"
#include "tools/terrain/interruption.hpp"
#include "tools/terrain/progress_bar.hpp"
#include "tools/terrain/vertical_datum.hpp"

namespace eyepoint::tools {

namespace {

constexpr std::uint64_t kProgressSteps = 1000;

struct BuildOptions {
    std::vector<std::string> dem;
    std::vector<std::string> imagery;
    std::string output;
    std::string name;
    std::string vertical = "egm96";
    std::string encoding = "metres";
    std::string sea = "auto";
    std::optional<double> nodata;
    std::string extent;
    std::string mercator_tile;
    std::uint32_t max_depth = terrain::kMaxDepth;
    bool json = false;
};

/// Everything read, before it is joined.
struct Inputs {
    std::vector<HeightGrid> grids;
    std::vector<ColourGrid> pictures;
};

template <typename Value>
using Result = tl::expected<Value, std::string>;

Result<ElevationDefaults> elevation_defaults(const BuildOptions& options) {
    ElevationDefaults defaults;
    defaults.encoding = *height_encoding_named(options.encoding);
    defaults.datum = *vertical_datum_named(options.vertical);
    defaults.nodata = options.nodata;
    if (!options.extent.empty()) {
        const auto extent = parse_extent(options.extent);
        if (!extent) return tl::unexpected("--extent: " + extent.error());
        defaults.placement = *extent;
    } else if (!options.mercator_tile.empty()) {
        const auto tile = parse_mercator_tile(options.mercator_tile);
        if (!tile) return tl::unexpected("--mercator-tile: " + tile.error());
        defaults.placement = *tile;
    }
    return defaults;
}

/// Reads every file; the bar shows files, each in kProgressSteps.
Result<Inputs> read_inputs(const BuildOptions& options, const terrain::Geoid& geoid) {
    const auto defaults = elevation_defaults(options);
    if (!defaults) return tl::unexpected(defaults.error());
    const auto elevation = elevation_inputs(options.dem, *defaults);
    if (!elevation) return tl::unexpected(elevation.error());
    const auto imagery = imagery_inputs(options.imagery);
    if (!imagery) return tl::unexpected(imagery.error());

    ProgressBar bar{"reading"};
    std::uint64_t done = 0;
    const std::uint64_t total = (elevation->size() + imagery->size()) * kProgressSteps;
    const ReadProgress progress = [&](double share) {
        bar.show(done + static_cast<std::uint64_t>(share * kProgressSteps), total);
        return !was_interrupted();
    };
    Inputs inputs;
    std::uint64_t posts = 0;
    for (const ElevationInput& input : *elevation) {
        auto grid = read_elevation(input, progress);
        if (!grid) return tl::unexpected(grid.error());
        posts += grid->heights_m.size();
        if (posts > kMaxPosts) {
            return tl::unexpected(
                fmt::format("{}: with it the elevation is more than the {} million posts that are read "
                            "at once; build a smaller region",
                            input.file, kMaxPosts / 1'000'000));
        }
        grid->order = inputs.grids.size();
        inputs.grids.push_back(input.datum == VerticalDatum::Ellipsoid ? to_msl(std::move(*grid), geoid)
                                                                       : std::move(*grid));
        done += kProgressSteps;
    }
    std::uint64_t pixels = 0;
    for (const ImageryInput& input : *imagery) {
        auto picture = read_imagery(input, progress);
        if (!picture) return tl::unexpected(picture.error());
        pixels += picture->rgba.size() / 4;
        if (pixels > kMaxPixels) {
            return tl::unexpected(
                fmt::format("{}: with it the imagery is more than the {} million pixels that are read "
                            "at once; build a smaller region",
                            input.file, kMaxPixels / 1'000'000));
        }
        inputs.pictures.push_back(std::move(*picture));
        done += kProgressSteps;
    }
    return inputs;
}

/// Imagery that lies over none of the elevation files is a mistake in one of the two.
Result<void> check_overlap(const Inputs& inputs) {
    for (const ColourGrid& picture : inputs.pictures) {
        const auto bounds = bounds_of(picture.mapping, picture.columns, picture.rows);
        const bool over_some =
            std::any_of(inputs.grids.begin(), inputs.grids.end(), [&](const HeightGrid& grid) {
                return meet(bounds, bounds_of(grid.mapping, grid.columns, grid.rows));
            });
        if (over_some) continue;
        return tl::unexpected(
            fmt::format("{}: this imagery (at {:.3f} N, {:.3f} E) lies over none of the elevation; "
                        "add elevation there or leave it out",
                        picture.facts.file, bounds.south_deg, bounds.west_deg));
    }
    return {};
}

std::string default_name(const BuildOptions& options) {
    const std::string first = std::filesystem::path{options.dem.front()}.stem().string();
    const std::size_t more = options.dem.size() - 1;
    return more == 0 ? first : fmt::format("{} and {} more", first, more);
}

terrain::Manifest manifest_of(const BuildOptions& options, const BuildReport& report) {
    terrain::Manifest manifest;
    manifest.name = options.name.empty() ? default_name(options) : options.name;
    manifest.created_by = "eyepoint-terrain " EYEPOINT_VERSION;
    const auto file_name = [](const FileFacts& file) {
        return std::filesystem::path{file.file}.filename().string();
    };
    for (const LayerFacts& layer : report.elevation) {
        manifest.voids_filled += layer.voids_filled;
        for (const FileFacts& file : layer.files) {
            manifest.sources.push_back({file_name(file), "elevation", std::string{name_of(file.datum)},
                                        file.spacing_deg, file.voids});
        }
    }
    for (const FileFacts& file : report.imagery) {
        manifest.sources.push_back({file_name(file), "imagery", "", file.spacing_deg, 0});
    }
    return manifest;
}

Result<BuildReport> build(const BuildOptions& options) {
    const auto start = std::chrono::steady_clock::now();
    const auto geoid = terrain::Geoid::load(terrain::Geoid::default_grid());
    if (!geoid) return tl::unexpected(geoid.error());
    auto inputs = read_inputs(options, *geoid);
    if (was_interrupted()) return tl::unexpected(std::string{"the build was interrupted"});
    if (!inputs) return tl::unexpected(inputs.error());
    if (const auto fit = check_overlap(*inputs); !fit) return tl::unexpected(fit.error());

    BuildReport report{.output = options.output, .manifest = {}, .elevation = {}, .imagery = {}, .notes = {}};
    auto joining = std::make_unique<ProgressBar>("joining");
    const Mosaic elevation{join_neighbours(std::move(inputs->grids)),
                           *geoid,
                           {*sea_rule_named(options.sea), options.max_depth},
                           [&](std::size_t done, std::size_t total) { joining->show(done, total); }};
    joining.reset();
    report.elevation = elevation.facts();
    if (!elevation.is_global()) {
        report.notes.emplace_back(
            "no elevation file covers the whole Earth: beyond them the planet is sea at MSL 0");
    }
    std::optional<ImageMosaic> imagery;
    if (!inputs->pictures.empty()) {
        imagery.emplace(std::move(inputs->pictures), options.max_depth);
        report.imagery = imagery->facts();
        if (!imagery->is_global()) {
            report.notes.emplace_back(
                "no imagery covers the whole Earth: beyond it the ground is one plain colour");
        }
    }
    ProgressBar bar{"compiling"};
    CompileRequest request;
    request.elevation = &elevation;
    request.imagery = imagery ? &*imagery : nullptr;
    request.geoid = &*geoid;
    request.manifest = manifest_of(options, report);
    request.output = options.output;
    request.progress = [&](std::uint64_t done, std::uint64_t total) { bar.show(done, total); };
    request.cancelled = was_interrupted;
    auto made = compile_database(request);
    if (!made) return tl::unexpected(made.error());
    report.manifest = std::move(*made);
    report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return report;
}

void run(const BuildOptions& options) {
    watch_for_interruption();
    const auto report = build(options);
    if (!report) fail("build", report.error());
    fmt::print("{}", options.json ? as_json(*report).dump(2) + "\n" : as_text(*report));
}

}  // namespace

void add_build_command(CLI::App& application) {
    auto options = std::make_shared<BuildOptions>();
    auto* command = application.add_subcommand(
        "build", "Makes a terrain database from elevation and imagery files (docs/terrain-data.md).");
    command->footer(
        "A file takes its own settings as FILE@KEY=VALUE; keys: vertical, encoding, nodata, band, extent,\n"
        "mercator-tile (elevation), extent, nodata (imagery). A folder stands for the rasters below it.\n"
        "Examples:\n"
        "  eyepoint-terrain build --dem N46E008.hgt.zip world.tif --imagery world.jpg -o alps\n"
        "  eyepoint-terrain build --dem fuji.png --encoding terrain-rgb --mercator-tile 10/906/404 -o fuji\n"
        "  eyepoint-terrain build --dem lidar.tif@vertical=ellipsoid srtm.tif -o airfield");
    command
        ->add_option("--dem", options->dem, "Elevation: files or folders; finest wins, then the order given")
        ->required();
    command->add_option("--imagery", options->imagery,
                        "Pictures: files or folders; finest wins, then the order given");
    command
        ->add_option("-o,--output", options->output, "Folder of the database; one there before is replaced")
        ->required();
    command->add_option("--name", options->name, "Name of the database, for people");
    command->add_option("--vertical", options->vertical, "What heights are measured from")
        ->check(CLI::IsMember({"egm96", "ellipsoid"}))
        ->capture_default_str();
    command
        ->add_option("--encoding", options->encoding, "How elevation files with three 8-bit bands are read")
        ->check(CLI::IsMember({"metres", "terrain-rgb"}))
        ->capture_default_str();
    command->add_option("--sea", options->sea, "Which posts at or below 0 m are sea")
        ->check(CLI::IsMember({"auto", "none", "clamp"}))
        ->capture_default_str();
    command->add_option("--nodata", options->nodata,
                        "Value of void posts, over what the elevation files say");
    auto* extent = command->add_option("--extent", options->extent,
                                       "W,S,E,N in degrees of the file without georeference");
    command->add_option("--mercator-tile", options->mercator_tile, "Z/X/Y of the file without georeference")
        ->excludes(extent);
    command->add_option("--max-depth", options->max_depth, "Deepest tiles made")
        ->check(CLI::Range(0U, terrain::kMaxDepth + 0U));
    command->add_flag("--json", options->json, "Report as JSON");
    command->callback([options] { run(*options); });
}

}  // namespace eyepoint::tools
