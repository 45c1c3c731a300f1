#include "terrain/database/manifest_json.hpp"

#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace eyepoint::terrain {

namespace {

using nlohmann::ordered_json;

ordered_json source_to_json(const SourceRecord& source) {
    return {{"file", source.file},
            {"kind", source.kind},
            {"vertical_datum", source.vertical_datum},
            {"spacing_deg", source.spacing_deg},
            {"voids", source.voids}};
}

SourceRecord source_from_json(const ordered_json& json) {
    return {json.at("file").get<std::string>(), json.at("kind").get<std::string>(),
            json.at("vertical_datum").get<std::string>(), json.at("spacing_deg").get<double>(),
            json.at("voids").get<std::uint64_t>()};
}

GeographicExtent extent_from_json(const ordered_json& json) {
    return {json.at("west_deg").get<double>(), json.at("south_deg").get<double>(),
            json.at("east_deg").get<double>(), json.at("north_deg").get<double>()};
}

Manifest content_from_json(const ordered_json& json) {
    Manifest manifest;
    manifest.name = json.at("name").get<std::string>();
    manifest.created_by = json.at("created_by").get<std::string>();
    manifest.height_step_m = json.at("height_step_m").get<double>();
    manifest.max_depth = json.at("max_depth").get<std::uint32_t>();
    manifest.tiles = json.at("tiles").get<std::uint64_t>();
    manifest.image_tiles = json.at("image_tiles").get<std::uint64_t>();
    manifest.voids_filled = json.at("voids_filled").get<std::uint64_t>();
    manifest.detail_extent = extent_from_json(json.at("detail_extent"));
    for (const auto& source : json.at("sources")) manifest.sources.push_back(source_from_json(source));
    return manifest;
}

}  // namespace

std::string to_json(const Manifest& manifest) {
    ordered_json sources = ordered_json::array();
    for (const SourceRecord& source : manifest.sources) sources.push_back(source_to_json(source));
    const GeographicExtent& detail = manifest.detail_extent;
    const ordered_json json = {{"format", kFormatName},
                               {"format_version", Manifest::kFormatVersion},
                               {"name", manifest.name},
                               {"created_by", manifest.created_by},
                               {"height_step_m", manifest.height_step_m},
                               {"max_depth", manifest.max_depth},
                               {"tiles", manifest.tiles},
                               {"image_tiles", manifest.image_tiles},
                               {"voids_filled", manifest.voids_filled},
                               {"detail_extent",
                                {{"west_deg", detail.west_deg},
                                 {"south_deg", detail.south_deg},
                                 {"east_deg", detail.east_deg},
                                 {"north_deg", detail.north_deg}}},
                               {"sources", std::move(sources)}};
    return json.dump(4, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

tl::expected<Manifest, std::string> manifest_from_json(std::string_view text) {
    try {
        const auto json = ordered_json::parse(text);
        if (json.at("format").get<std::string>() != kFormatName) {
            return tl::unexpected(std::string{"it is no manifest of a terrain database"});
        }
        const auto version = json.at("format_version").get<std::int64_t>();
        if (version != Manifest::kFormatVersion) {
            return tl::unexpected(fmt::format("its format is version {}, this program reads version {}",
                                              version, Manifest::kFormatVersion));
        }
        auto manifest = content_from_json(json);
        if (!std::isfinite(manifest.height_step_m) || manifest.height_step_m < 1e-4 ||
            manifest.height_step_m > 1e3) {
            return tl::unexpected(fmt::format("its height_step_m is {}", manifest.height_step_m));
        }
        return manifest;
    } catch (const ordered_json::exception& fault) {
        return tl::unexpected(fmt::format("it is not a whole manifest ({})", fault.what()));
    }
}

}  // namespace eyepoint::terrain
