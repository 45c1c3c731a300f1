#include "tools/terrain/gdal_georeference.hpp"

#include <array>
#include <numbers>

#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include "terrain/geodesy/earth.hpp"

namespace eyepoint::tools {

tl::expected<GridMapping, std::string> own_georeference(GDALDataset& dataset) {
    std::array<double, 6> geotransform{};
    const bool placed = dataset.GetGeoTransform(geotransform.data()) == CE_None;
    const OGRSpatialReference* system = dataset.GetSpatialRef();
    if (!placed || system == nullptr || system->IsEmpty()) {
        return tl::unexpected(
            std::string{placed ? "has no coordinate system" : "has no georeference"} +
            "; give its edges with --extent W,S,E,N (degrees) or --mercator-tile Z/X/Y, or add one "
            "with gdal_translate -a_srs -a_ullr");
    }
    return GridMapping::create(geotransform, *system);
}

tl::expected<GridMapping, std::string> spread(const MercatorTile& tile, int columns, int rows) {
    // The Web Mercator square is half an equator's length to each side of 0, 0.
    const double half_side_m = std::numbers::pi * terrain::kEquatorialRadiusM;
    const double tile_side_m = 2.0 * half_side_m / static_cast<double>(std::uint64_t{1} << tile.zoom);
    OGRSpatialReference system;
    system.importFromEPSG(3857);
    return GridMapping::create({tile.x * tile_side_m - half_side_m, tile_side_m / columns, 0.0,
                                half_side_m - tile.y * tile_side_m, 0.0, -tile_side_m / rows},
                               system);
}

tl::expected<GridMapping, std::string> georeference_of(GDALDataset& dataset, const ElevationInput& input) {
    const int columns = dataset.GetRasterXSize();
    const int rows = dataset.GetRasterYSize();
    if (const auto* edges = std::get_if<terrain::GeographicExtent>(&input.placement)) {
        return GridMapping::spread(*edges, columns, rows);
    }
    if (const auto* tile = std::get_if<MercatorTile>(&input.placement)) return spread(*tile, columns, rows);
    return own_georeference(dataset);
}

}  // namespace eyepoint::tools
