#include "tools/terrain/build_command_report.hpp"

#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "terrain/geodesy/earth.hpp"
#include "tools/terrain/vertical_datum.hpp"

namespace eyepoint::tools {

namespace {

std::string spacing_text(double degrees) {
    const double metres = degrees * std::numbers::pi / 180.0 * terrain::kEquatorialRadiusM;
    return fmt::format("{:.4g}\" ({:.0f} m)", degrees * 3600.0, metres);
}

std::string extent_text(const terrain::GeographicExtent& extent) {
    return fmt::format("{:.4f}..{:.4f} N, {:.4f}..{:.4f} E", extent.south_deg, extent.north_deg,
                       extent.west_deg, extent.east_deg);
}

void append_layer(std::string& text, const LayerFacts& layer) {
    std::uint64_t voids = 0;
    for (const FileFacts& file : layer.files) {
        text += fmt::format("  {}: {} x {} posts, {}, {}\n", file.file, file.columns, file.rows,
                            spacing_text(file.spacing_deg), name_of(file.datum));
        for (const std::string& note : file.notes) text += fmt::format("    note: {}\n", note);
        voids += file.voids;
    }
    text += fmt::format("    covers {}{}\n", extent_text(layer.bounds),
                        layer.files.size() > 1 ? fmt::format(", {} files joined", layer.files.size()) : "");
    if (layer.voids_filled > 0) {
        text += fmt::format("    {} voids filled from their rims{}\n", layer.voids_filled,
                            layer.filled_over_coarser ? " over the shape of the coarser data" : "");
    }
    if (layer.voids_outside > 0) {
        text += fmt::format("    {} void posts too far from any height: coarser data shows there\n",
                            layer.voids_outside);
    }
    if (voids == 0) text += "    no voids\n";
    if (layer.sea_posts > 0) text += fmt::format("    {} posts of sea, set to MSL 0\n", layer.sea_posts);
    if (layer.margin_posts > 0) {
        text += fmt::format("    fades into coarser data over {} posts at its edge\n", layer.margin_posts);
    }
}

nlohmann::json extent_json(const terrain::GeographicExtent& extent) {
    return {{"west_deg", extent.west_deg},
            {"south_deg", extent.south_deg},
            {"east_deg", extent.east_deg},
            {"north_deg", extent.north_deg}};
}

nlohmann::json file_json(const FileFacts& file) {
    return {{"file", file.file},
            {"columns", file.columns},
            {"rows", file.rows},
            {"spacing_deg", file.spacing_deg},
            {"notes", file.notes}};
}

nlohmann::json layer_json(const LayerFacts& layer) {
    nlohmann::json files = nlohmann::json::array();
    for (const FileFacts& file : layer.files) {
        nlohmann::json entry = file_json(file);
        entry["vertical_datum"] = name_of(file.datum);
        entry["voids"] = file.voids;
        files.push_back(std::move(entry));
    }
    return {{"files", std::move(files)},
            {"spacing_deg", layer.spacing_deg},
            {"extent", extent_json(layer.bounds)},
            {"voids_filled", layer.voids_filled},
            {"voids_filled_over_coarser_data", layer.filled_over_coarser},
            {"voids_outside", layer.voids_outside},
            {"sea_posts", layer.sea_posts},
            {"margin_posts", layer.margin_posts}};
}

}  // namespace

std::string as_text(const BuildReport& report) {
    const terrain::Manifest& made = report.manifest;
    std::string text =
        fmt::format("{}: {} tiles to depth {}, posts {}; {} with imagery; {:.1f} s\n", report.output,
                    made.tiles, made.max_depth, spacing_text(terrain::post_spacing_deg(made.max_depth)),
                    made.image_tiles, report.seconds);
    text += "elevation, finest first\n";
    for (const LayerFacts& layer : report.elevation) append_layer(text, layer);
    if (!report.imagery.empty()) text += "imagery, finest first\n";
    for (const FileFacts& file : report.imagery) {
        text += fmt::format("  {}: {} x {} pixels, {}\n", file.file, file.columns, file.rows,
                            spacing_text(file.spacing_deg));
        for (const std::string& note : file.notes) text += fmt::format("    note: {}\n", note);
    }
    for (const std::string& note : report.notes) text += fmt::format("note: {}\n", note);
    return text;
}

nlohmann::json as_json(const BuildReport& report) {
    nlohmann::json elevation = nlohmann::json::array();
    for (const LayerFacts& layer : report.elevation) elevation.push_back(layer_json(layer));
    nlohmann::json imagery = nlohmann::json::array();
    for (const FileFacts& file : report.imagery) imagery.push_back(file_json(file));
    return {{"output", report.output},
            {"tiles", report.manifest.tiles},
            {"image_tiles", report.manifest.image_tiles},
            {"max_depth", report.manifest.max_depth},
            {"voids_filled", report.manifest.voids_filled},
            {"seconds", report.seconds},
            {"elevation", std::move(elevation)},
            {"imagery", std::move(imagery)},
            {"notes", report.notes}};
}

}  // namespace eyepoint::tools
