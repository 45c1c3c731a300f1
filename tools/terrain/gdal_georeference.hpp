/// Where a raster file lies on the Earth, from the file or from what the user says.
#pragma once

#include <string>

#include <tl/expected.hpp>

#include "tools/terrain/gdal_elevation.hpp"
#include "tools/terrain/gdal_mapping.hpp"

namespace eyepoint::tools {

/// The placement given with the input, else the file's own. On failure: a sentence without the file's name.
[[nodiscard]] tl::expected<GridMapping, std::string> georeference_of(GDALDataset& dataset,
                                                                     const ElevationInput& input);

/// The file's own georeference, if it has one.
[[nodiscard]] tl::expected<GridMapping, std::string> own_georeference(GDALDataset& dataset);

/// A square picture of a Web Mercator tile (EPSG:3857), edge to edge.
[[nodiscard]] tl::expected<GridMapping, std::string> spread(const MercatorTile& tile, int columns, int rows);

}  // namespace eyepoint::tools
