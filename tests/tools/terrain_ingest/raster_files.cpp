#include "tests/tools/terrain_ingest/raster_files.hpp"

#include <cstdlib>
#include <stdexcept>

#include <gdal_priv.h>
#include <ogr_spatialref.h>
#include <unistd.h>

#include "tools/terrain/gdal_session.hpp"

namespace eyepoint::tools::testing {

TemporaryFolder::TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "eyepoint-ingest-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    folder_ = name;
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
}

void write_raster(const std::string& path, const RasterFile& file,
                  const std::function<double(int, int, int)>& value) {
    start_gdal();
    const GDALDataType type = file.pixel == Pixel::Byte    ? GDT_Byte
                              : file.pixel == Pixel::Int16 ? GDT_Int16
                                                           : GDT_Float32;
    // Drivers such as PNG only copy: everything is made in memory first.
    GDALDriverManager& drivers = *GetGDALDriverManager();
    const Dataset memory{
        drivers.GetDriverByName("MEM")->Create("", file.columns, file.rows, file.bands, type, nullptr)};
    for (int band = 0; band < file.bands; ++band) {
        std::vector<double> values;
        for (int row = 0; row < file.rows; ++row) {
            for (int column = 0; column < file.columns; ++column) values.push_back(value(band, column, row));
        }
        GDALRasterBand& target = *memory->GetRasterBand(band + 1);
        if (file.nodata) target.SetNoDataValue(*file.nodata);
        if (target.RasterIO(GF_Write, 0, 0, file.columns, file.rows, values.data(), file.columns, file.rows,
                            GDT_Float64, 0, 0, nullptr) != CE_None) {
            throw std::runtime_error("raster not written");
        }
    }
    if (file.geotransform) {
        std::array<double, 6> geotransform = *file.geotransform;
        memory->SetGeoTransform(geotransform.data());
    }
    if (file.epsg != 0) {
        OGRSpatialReference system;
        system.importFromEPSG(file.epsg);
        memory->SetSpatialRef(&system);
    }
    const Dataset copy{drivers.GetDriverByName(file.driver.c_str())
                           ->CreateCopy(path.c_str(), memory.get(), FALSE, nullptr, nullptr, nullptr)};
    if (!copy) throw std::runtime_error("raster not written");
}

std::array<double, 6> posts_from(double west_deg, double north_deg, double spacing_deg) {
    return {west_deg - 0.5 * spacing_deg, spacing_deg, 0.0, north_deg + 0.5 * spacing_deg, 0.0, -spacing_deg};
}

HeightGrid grid_of(int columns, int rows, double west_deg, double north_deg, double spacing_deg,
                   const std::function<double(int, int)>& height_m) {
    const double half = 0.5 * spacing_deg;
    HeightGrid grid{
        .columns = columns,
        .rows = rows,
        .heights_m = {},
        .mapping = GridMapping::spread({west_deg - half, north_deg + half - rows * spacing_deg,
                                        west_deg - half + columns * spacing_deg, north_deg + half},
                                       columns, rows),
        .spacing_deg = spacing_deg,
        .files = {{"grid", VerticalDatum::Egm96, columns, rows, spacing_deg, 0, {}}},
        .order = 0};
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            grid.heights_m.push_back(static_cast<float>(height_m(column, row)));
        }
    }
    return grid;
}

const terrain::Geoid& geoid() {
    static const terrain::Geoid grid = [] {
        auto loaded = terrain::Geoid::load(terrain::Geoid::default_grid());
        if (!loaded) throw std::runtime_error(loaded.error());
        return std::move(*loaded);
    }();
    return grid;
}

std::optional<std::string> real_data(const std::string& below) {
    const char* folder = std::getenv("EYEPOINT_REAL_DATA");
    if (folder == nullptr) return std::nullopt;
    return std::string{folder} + "/" + below;
}

}  // namespace eyepoint::tools::testing
