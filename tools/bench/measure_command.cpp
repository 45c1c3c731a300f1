/// eyepoint-bench measure: what a level-of-detail method draws and how far that is from the truth, without
/// drawing.
#include <algorithm>
#include <fstream>
#include <memory>
#include <optional>

#include <fmt/format.h>

#include "ig/lod_view.hpp"
#include "ig/output/picture_folder.hpp"
#include "terrain/database/database.hpp"
#include "tools/bench/allocation_count.hpp"
#include "tools/bench/command_options.hpp"
#include "tools/bench/eyes.hpp"
#include "tools/bench/measure/error_picture.hpp"
#include "tools/bench/measure/tolerance_match.hpp"
#include "tools/bench/measure_report.hpp"

namespace eyepoint::tools {

namespace {

struct MeasureRequest {
    EyesRequest eyes;
    std::filesystem::path terrain;
    FlightOptions flight;
    MeasureOptions options{.every = 20};
    double tau_px = 1.0;
    double slack_px = 0.0;
    std::string morph = "on";
    bool selection_only = false;
    std::size_t first_frames = 0;
    std::optional<double> match_p999_px;
    std::optional<std::filesystem::path> json;
    std::optional<std::filesystem::path> error_pictures;
};

std::vector<ig::FlightEye> eyes_of(const MeasureRequest& request) {
    auto eyes = read_eyes(request.eyes);
    if (!eyes) fail(eyes.error());
    if (request.first_frames > 0 && request.first_frames < eyes->size()) eyes->resize(request.first_frames);
    return std::move(*eyes);
}

std::vector<terrain::LodView> views_of(const MeasureRequest& request,
                                       const std::vector<ig::FlightEye>& eyes) {
    std::vector<terrain::LodView> views;
    for (const ig::FlightEye& eye : eyes) {
        views.push_back(ig::lod_view(eye.eyepoint.view, request.tau_px, request.slack_px));
        views.back().time_s = eye.time_s;
        views.back().drawn_frame = views.size();
    }
    return views;
}

/// Writes the error view of every measured frame.
SeePosts error_painter(const std::filesystem::path& folder, const std::vector<ig::FlightEye>& eyes) {
    const auto opened = ig::PictureFolder::open(folder);
    if (!opened) fail(opened.error());
    return [pictures = *opened, &eyes](std::size_t frame, const PostView& view, const MeasuredPosts& posts) {
        const ig::View& eye = eyes[frame].eyepoint.view;
        const PictureCamera camera{eye.axes, eye.left,     eye.right,    eye.bottom,
                                   eye.top,  eye.width_px, eye.height_px};
        const ErrorPicture painted = paint_error(posts, view, camera);
        ig::Picture picture{{painted.width_px, painted.height_px}, {}};
        for (std::size_t i = 0; i < painted.rgb.size(); i += 3)
            picture.rgba.insert(picture.rgba.end(),
                                {painted.rgb[i], painted.rgb[i + 1], painted.rgb[i + 2], 255});
        return pictures.write(picture, frame + 1);
    };
}

nlohmann::json header(const MeasureRequest& request) {
    return {{"path", request.eyes.file.filename().string()},
            {"lod", request.flight.lod_method},
            {"tau_px", request.tau_px},
            {"triangle_budget", request.flight.triangle_budget},
            {"slack_px", request.slack_px},
            {"morph", request.options.morph},
            {"width_px", request.eyes.size.width_px},
            {"height_px", request.eyes.size.height_px},
            {"vertical_fov_deg", request.eyes.vertical_fov_deg}};
}

void run_match(const MeasureRequest& request, LodFlight& flight, FullSurface& surface,
               const std::vector<terrain::LodView>& views) {
    std::vector<terrain::LodView> sampled;
    for (std::size_t i = 0; i < views.size(); i += request.options.every) sampled.push_back(views[i]);
    const auto match = match_p999(flight, surface, sampled, *request.match_p999_px,
                                  request.slack_px / request.tau_px, request.options);
    if (!match) fail(match.error());
    fmt::print("{}: post error p99.9 <= {} px at tau {:.3f} px\n{}", request.flight.lod_method,
               *request.match_p999_px, match->tau_px, describe(match->figures));
    if (!request.json) return;
    nlohmann::json json = header(request);
    json["tau_px"] = match->tau_px;
    json["match_p999_px"] = *request.match_p999_px;
    json["flight"] = to_json(match->figures);
    write_or_fail(*request.json, json.dump(2) + "\n");
}

void run_measure(const MeasureRequest& request, LodFlight& flight, FullSurface& surface,
                 const std::vector<ig::FlightEye>& eyes) {
    const SeePosts see = request.error_pictures ? error_painter(*request.error_pictures, eyes) : SeePosts{};
    const auto frames = measure_flight(flight, surface, views_of(request, eyes), request.options, see);
    if (!frames) fail(frames.error());
    const FlightFigures figures = summarise(*frames);
    fmt::print("{}, tau {} px, slack {} px, morph {}: {}", request.flight.lod_method, request.tau_px,
               request.slack_px, request.morph, describe(figures));
    if (!request.json) return;
    nlohmann::json json = header(request);
    json["flight"] = to_json(figures);
    for (const FrameMeasure& frame : *frames) json["frames"].push_back(to_json(frame));
    write_or_fail(*request.json, json.dump(2) + "\n");
}

void run(MeasureRequest request) {
    request.options.morph = request.flight.tile.morph = request.morph == "on";
    if (request.selection_only) request.options.posts = request.options.pops = request.options.faults = false;
    request.flight.allocations = heap_allocations;
    const std::vector<ig::FlightEye> eyes = eyes_of(request);
    auto opened = terrain::Database::open(request.terrain);
    if (!opened) fail(opened.error());
    const auto database = std::make_shared<const terrain::Database>(std::move(*opened));
    auto flight = LodFlight::create(database, request.flight);
    if (!flight) fail(flight.error());
    FullSurface surface(database);
    if (request.match_p999_px)
        run_match(request, **flight, surface, views_of(request, eyes));
    else
        run_measure(request, **flight, surface, eyes);
}

void add_measuring(CLI::App& command, MeasureRequest& request) {
    command.add_option("--lod", request.flight.lod_method, "level-of-detail method")->capture_default_str();
    command.add_option("--tau", request.tau_px, "tolerance, pixels")
        ->check(CLI::Range(0.05, 100.0))
        ->capture_default_str();
    command.add_option("--slack", request.slack_px, "slack, pixels")
        ->check(CLI::Range(0.0, 100.0))
        ->capture_default_str();
    command.add_option("--morph", request.morph, "vertices slide between levels, or jump")
        ->check(CLI::IsMember({"on", "off"}))
        ->capture_default_str();
    command.add_flag("--cull", request.flight.cull,
                     "nested alone: leave out what nearer terrain hides; posts there count as uncovered");
    command.add_flag("--selection-only", request.selection_only,
                     "measure what selection does, not the mesh: no post error, no jumps, no cracks");
    command.add_option("--triangles", request.flight.triangle_budget,
                       "bintree alone: triangles a frame at most; 0: no limit");
    add_selective_options(command, request.flight.selective);
    add_tile_options(command, request.flight.tile);
    add_hyperblock_options(command, request.flight.hyperblock);
    command.add_option("--every", request.options.every, "measure every so-manieth frame")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    command.add_option("--frames", request.first_frames, "only the first so many frames");
    command.add_option("--far", request.options.far_m, "posts beyond are not looked at, metres")
        ->capture_default_str();
    command
        .add_option(
            "--match-p999", request.match_p999_px,
            "find the tolerance at which 99.9% of the posts err by at most so many pixels (1.12 is the "
            "field's measure)")
        ->check(CLI::Range(0.05, 50.0));
    command
        .add_option(
            "--error-pictures", request.error_pictures,
            "a picture of each measured frame's post error: blue 0, green tau / 2, yellow tau, red 2 tau and "
            "more, magenta a hole")
        ->type_name("DIR");
    command.add_option("--json", request.json, "figures as JSON")->type_name("FILE");
}

}  // namespace

void add_measure_command(CLI::App& program) {
    auto request = std::make_shared<MeasureRequest>();
    auto* command = program.add_subcommand(
        "measure",
        "Measures a level-of-detail method along a path: triangles, post error, pops, cracks, work.");
    command
        ->add_option("path", request->eyes.file,
                     "path over the benchmark field (csv) or recorded flight (pcap)")
        ->required()
        ->check(CLI::ExistingFile);
    command->add_option("--terrain", request->terrain, "terrain database")->type_name("DB")->required();
    add_size_option(*command, request->eyes.size);
    command->add_option("--fov", request->eyes.vertical_fov_deg, "vertical field of view, degrees")
        ->check(CLI::Range(1.0, 170.0))
        ->capture_default_str();
    command->add_option("--rate", request->eyes.rate_hz, "frames a second of a recorded flight")
        ->check(CLI::Range(0.01, 1000.0))
        ->capture_default_str();
    command->add_flag("--ellipsoid", request->eyes.ellipsoid,
                      "a recorded flight's altitudes are above the ellipsoid, not the sea");
    command->add_option("--from", request->eyes.from_s, "start of the part of a recorded flight, seconds");
    command->add_option("--until", request->eyes.until_s, "its end, seconds");
    add_measuring(*command, *request);
    command->callback([request] { run(*request); });
    command->footer(
        "Example: eyepoint-bench measure cruise.csv --terrain FIELD --lod tile --tau 1.3 --json out.json\n"
        "         eyepoint-bench measure cruise.csv --terrain FIELD --match-p999 1.12");
}

}  // namespace eyepoint::tools
