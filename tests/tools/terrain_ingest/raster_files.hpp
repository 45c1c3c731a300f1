/// Small raster files and grids that the tests make for themselves.
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "terrain/geodesy/geoid.hpp"
#include "tools/terrain/mosaic_grid.hpp"

namespace eyepoint::tools::testing {

/// A folder that goes with everything in it.
class TemporaryFolder {
  public:
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    [[nodiscard]] std::string path(const std::string& name) const { return (folder_ / name).string(); }

  private:
    std::filesystem::path folder_;
};

enum class Pixel { Byte, Int16, Float32 };

struct RasterFile {
    int columns = 0;
    int rows = 0;
    int bands = 1;
    Pixel pixel = Pixel::Float32;
    std::optional<std::array<double, 6>> geotransform;
    int epsg = 4326;  ///< 0: none
    std::optional<double> nodata;
    std::string driver = "GTiff";
};

/// value(band from 0, column, row from the north).
void write_raster(const std::string& path, const RasterFile& file,
                  const std::function<double(int, int, int)>& value);

/// Geotransform of a north-up grid whose first post (north-west) is at the given place.
[[nodiscard]] std::array<double, 6> posts_from(double west_deg, double north_deg, double spacing_deg);

/// A grid in memory, its first post in the north-west.
[[nodiscard]] HeightGrid grid_of(int columns, int rows, double west_deg, double north_deg, double spacing_deg,
                                 const std::function<double(int, int)>& height_m);

[[nodiscard]] const terrain::Geoid& geoid();

/// A file of the real data, or nothing where there is none.
[[nodiscard]] std::optional<std::string> real_data(const std::string& below);

}  // namespace eyepoint::tools::testing
