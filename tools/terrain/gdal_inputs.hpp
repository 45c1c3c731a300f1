/// The files named on the command line, as inputs with their options.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <tl/expected.hpp>

#include "tools/terrain/gdal_elevation.hpp"
#include "tools/terrain/gdal_imagery.hpp"

namespace eyepoint::tools {

/// What holds for every elevation file that does not say otherwise itself.
struct ElevationDefaults {
    HeightEncoding encoding = HeightEncoding::Metres;  ///< TerrainRgb: of files with three 8-bit bands
    VerticalDatum datum = VerticalDatum::Egm96;
    std::optional<double> nodata;
    /// Of the one file that has no georeference.
    std::variant<std::monostate, terrain::GeographicExtent, MercatorTile> placement;
};

/// "W,S,E,N" in degrees; east may be past 180.
[[nodiscard]] tl::expected<terrain::GeographicExtent, std::string> parse_extent(const std::string& text);
/// "Z/X/Y".
[[nodiscard]] tl::expected<MercatorTile, std::string> parse_mercator_tile(const std::string& text);
[[nodiscard]] std::optional<HeightEncoding> height_encoding_named(const std::string& name);

/// Arguments are FILE[@KEY=VALUE]... or a folder, which stands for the rasters below it (of a CDB folder: the
/// elevation tiles, finest level of each geocell). Keys: vertical, encoding, nodata, band, extent,
/// mercator-tile. On failure: one sentence naming the argument.
[[nodiscard]] tl::expected<std::vector<ElevationInput>, std::string> elevation_inputs(
    const std::vector<std::string>& arguments, const ElevationDefaults& defaults);

/// Likewise for imagery; keys: extent, nodata.
[[nodiscard]] tl::expected<std::vector<ImageryInput>, std::string> imagery_inputs(
    const std::vector<std::string>& arguments);

}  // namespace eyepoint::tools
