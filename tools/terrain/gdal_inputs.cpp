#include "tools/terrain/gdal_inputs.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>
#include <gdal_priv.h>

#include "tools/terrain/gdal_folder.hpp"
#include "tools/terrain/gdal_georeference.hpp"
#include "tools/terrain/vertical_datum.hpp"

namespace eyepoint::tools {

namespace {

constexpr std::array<std::string_view, 6> kElevationKeys{"vertical", "encoding", "nodata",
                                                         "band",     "extent",   "mercator-tile"};
constexpr std::array<std::string_view, 2> kImageryKeys{"extent", "nodata"};

struct Setting {
    std::string key;
    std::string value;
};

struct Argument {
    std::string file;
    std::vector<Setting> settings;
};

/// Takes @KEY=VALUE off the end for as long as KEY is known: file names may hold an @ themselves.
Argument split(std::string text, std::span<const std::string_view> keys) {
    Argument argument;
    for (std::size_t at = text.rfind('@'); at != std::string::npos; at = text.rfind('@')) {
        const std::size_t equals = text.find('=', at);
        if (equals == std::string::npos) break;
        Setting setting{text.substr(at + 1, equals - at - 1), text.substr(equals + 1)};
        if (std::find(keys.begin(), keys.end(), setting.key) == keys.end()) break;
        argument.settings.push_back(std::move(setting));
        text.resize(at);
    }
    argument.file = std::move(text);
    return argument;
}

template <typename Number>
std::optional<Number> number(std::string_view text) {
    Number value{};
    const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (failure != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return value;
}

template <typename Number>
std::vector<Number> numbers(std::string_view text, char separator) {
    std::vector<Number> values;
    while (true) {
        const std::size_t end = text.find(separator);
        const auto value = number<Number>(text.substr(0, end));
        if (!value) return {};
        values.push_back(*value);
        if (end == std::string_view::npos) return values;
        text.remove_prefix(end + 1);
    }
}

tl::expected<void, std::string> apply(const Setting& setting, ElevationInput& input) {
    const auto wrong = [&](std::string_view expected) {
        return tl::unexpected(
            fmt::format("{}: @{}={} is no {}", input.file, setting.key, setting.value, expected));
    };
    if (setting.key == "vertical") {
        const auto datum = vertical_datum_named(setting.value);
        if (!datum) return wrong("datum; egm96 and ellipsoid are");
        input.datum = *datum;
    } else if (setting.key == "encoding") {
        const auto encoding = height_encoding_named(setting.value);
        if (!encoding) return wrong("encoding; metres and terrain-rgb are");
        input.encoding = *encoding;
    } else if (setting.key == "nodata") {
        input.nodata = number<double>(setting.value);
        if (!input.nodata) return wrong("number");
    } else if (setting.key == "band") {
        input.band = number<int>(setting.value);
        if (!input.band) return wrong("band number, which counts from 1");
    } else if (setting.key == "extent") {
        const auto extent = parse_extent(setting.value);
        if (!extent) return tl::unexpected(fmt::format("{}: @extent: {}", input.file, extent.error()));
        input.placement = *extent;
    } else {
        const auto tile = parse_mercator_tile(setting.value);
        if (!tile) return tl::unexpected(fmt::format("{}: @mercator-tile: {}", input.file, tile.error()));
        input.placement = *tile;
    }
    return {};
}

tl::expected<void, std::string> apply(const Setting& setting, ImageryInput& input) {
    if (setting.key == "nodata") {
        input.nodata = number<int>(setting.value);
        if (input.nodata) return {};
        return tl::unexpected(fmt::format("{}: @nodata={} is no whole number", input.file, setting.value));
    }
    const auto extent = parse_extent(setting.value);
    if (!extent) return tl::unexpected(fmt::format("{}: @extent: {}", input.file, extent.error()));
    input.extent = *extent;
    return {};
}

/// Files that an argument's path stands for.
tl::expected<std::vector<std::string>, std::string> files_of(const std::string& path, FolderContent content) {
    std::error_code failure;
    if (!std::filesystem::is_directory(path, failure)) return std::vector{path};
    auto files = rasters_below(path, content);
    if (files.empty())
        return tl::unexpected(fmt::format("{}: the folder holds no raster file of a known ending", path));
    return files;
}

bool sets(const Argument& argument, std::string_view key) {
    return std::any_of(argument.settings.begin(), argument.settings.end(),
                       [&](const Setting& setting) { return setting.key == key; });
}

bool is_colour_picture(GDALDataset& dataset) {
    return dataset.GetRasterCount() >= 3 && dataset.GetRasterBand(1)->GetRasterDataType() == GDT_Byte;
}

}  // namespace

tl::expected<terrain::GeographicExtent, std::string> parse_extent(const std::string& text) {
    const auto edges = numbers<double>(text, ',');
    if (edges.size() != 4 || !(edges[0] < edges[2]) || !(edges[1] < edges[3]) || edges[1] < -90.0 ||
        edges[3] > 90.0 || edges[2] - edges[0] > 360.0) {
        return tl::unexpected(fmt::format(
            "{} is no extent; W,S,E,N in degrees with W < E and S < N is, such as 138.5,35.1,138.9,35.5",
            text));
    }
    return terrain::GeographicExtent{edges[0], edges[1], edges[2], edges[3]};
}

tl::expected<MercatorTile, std::string> parse_mercator_tile(const std::string& text) {
    const auto parts = numbers<std::uint32_t>(text, '/');
    if (parts.size() != 3 || parts[0] > 30 || parts[1] >= (1U << parts[0]) || parts[2] >= (1U << parts[0])) {
        return tl::unexpected(fmt::format("{} is no Web Mercator tile; Z/X/Y is, such as 10/906/404", text));
    }
    return MercatorTile{static_cast<int>(parts[0]), parts[1], parts[2]};
}

std::optional<HeightEncoding> height_encoding_named(const std::string& name) {
    if (name == "metres") return HeightEncoding::Metres;
    if (name == "terrain-rgb") return HeightEncoding::TerrainRgb;
    return std::nullopt;
}

tl::expected<std::vector<ElevationInput>, std::string> elevation_inputs(
    const std::vector<std::string>& arguments, const ElevationDefaults& defaults) {
    std::vector<ElevationInput> inputs;
    std::string placed;
    for (const std::string& text : arguments) {
        const Argument argument = split(text, kElevationKeys);
        const auto files = files_of(argument.file, FolderContent::Elevation);
        if (!files) return tl::unexpected(files.error());
        for (const std::string& file : *files) {
            ElevationInput input;
            input.file = file;
            input.datum = defaults.datum;
            input.nodata = defaults.nodata;
            for (const Setting& setting : argument.settings) {
                if (const auto applied = apply(setting, input); !applied)
                    return tl::unexpected(applied.error());
            }
            const auto dataset = open_raster(file);
            if (!dataset) return tl::unexpected(dataset.error());
            if (!sets(argument, "encoding") && is_colour_picture(**dataset))
                input.encoding = defaults.encoding;
            const bool unplaced = input.placement.index() == 0 && defaults.placement.index() != 0;
            if (unplaced && !own_georeference(**dataset)) {
                if (!placed.empty()) {
                    return tl::unexpected(
                        fmt::format("{} and {} both have no georeference; give each its own, as "
                                    "FILE@extent=W,S,E,N or FILE@mercator-tile=Z/X/Y",
                                    placed, file));
                }
                placed = file;
                input.placement = defaults.placement;
            }
            inputs.push_back(std::move(input));
        }
    }
    if (defaults.placement.index() != 0 && placed.empty()) {
        return tl::unexpected(
            std::string{"every elevation file has its own georeference, so --extent and "
                        "--mercator-tile have nothing to place; FILE@extent=... overrides one"});
    }
    return inputs;
}

tl::expected<std::vector<ImageryInput>, std::string> imagery_inputs(
    const std::vector<std::string>& arguments) {
    std::vector<ImageryInput> inputs;
    for (const std::string& text : arguments) {
        const Argument argument = split(text, kImageryKeys);
        const auto files = files_of(argument.file, FolderContent::Imagery);
        if (!files) return tl::unexpected(files.error());
        for (const std::string& file : *files) {
            ImageryInput input{file, std::nullopt, std::nullopt};
            for (const Setting& setting : argument.settings) {
                if (const auto applied = apply(setting, input); !applied)
                    return tl::unexpected(applied.error());
            }
            inputs.push_back(std::move(input));
        }
    }
    return inputs;
}

}  // namespace eyepoint::tools
