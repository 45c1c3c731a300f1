/// Reading one elevation file into a grid of heights.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <variant>

#include <tl/expected.hpp>

#include "tools/terrain/gdal_session.hpp"
#include "tools/terrain/mosaic_grid.hpp"

namespace eyepoint::tools {

enum class HeightEncoding : std::uint8_t {
    Metres,      ///< numbers are heights (or feet, where the band says so)
    TerrainRgb,  ///< Mapbox: height = -10000 m + (R * 65536 + G * 256 + B) * 0.1 m
};

/// A tile of the Web Mercator tiling (z/x/y, y from the north), as map services number their pictures.
struct MercatorTile {
    int zoom = 0;
    std::uint32_t x = 0;
    std::uint32_t y = 0;
};

/// How a file is to be read.
struct ElevationInput {
    std::string file;
    HeightEncoding encoding = HeightEncoding::Metres;
    VerticalDatum datum = VerticalDatum::Egm96;
    std::optional<double> nodata;  ///< over what the file says
    std::optional<int> band;       ///< from 1; the only one, when not given
    /// Georeference over what the file says: edge to edge.
    std::variant<std::monostate, terrain::GeographicExtent, MercatorTile> placement;
};

/// Most posts read from all files of one build together: about 4 GB of memory while compiling.
inline constexpr std::uint64_t kMaxPosts = 400'000'000;

/// Asked between blocks of rows with the share read, 0..1; false stops the reading.
using ReadProgress = std::function<bool(double)>;

/// Opens a raster and refuses, from its header alone, what cannot be heights.
[[nodiscard]] tl::expected<Dataset, std::string> open_elevation(const ElevationInput& input);

/// Reads a whole file, heights as the file has them (datum not converted), its void posts as kVoid. Refuses
/// files without georeference, pictures, several bands without a choice, and values that are no heights on
/// Earth. On failure: one sentence with the file, the fault and what to do.
[[nodiscard]] tl::expected<HeightGrid, std::string> read_elevation(const ElevationInput& input,
                                                                   const ReadProgress& progress = {});

}  // namespace eyepoint::tools
