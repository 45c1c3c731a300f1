/// Grids of heights on their way from files into the mosaic.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "terrain/tiling/tile_id.hpp"
#include "tools/terrain/gdal_mapping.hpp"

namespace eyepoint::tools {

enum class VerticalDatum : std::uint8_t { Egm96, Ellipsoid };

/// Grids whose spacings differ by less than this factor are of one class.
inline constexpr double kLikeSpacing = 1.5;
/// Of a grid's shorter side: how far in from its edge it fades into what lies behind it.
inline constexpr double kMarginShare = 0.05;

inline constexpr float kVoid = std::numeric_limits<float>::quiet_NaN();
[[nodiscard]] inline bool is_void(float height_m) { return std::isnan(height_m); }

/// What was found in one file, for the report.
struct FileFacts {
    std::string file;
    VerticalDatum datum = VerticalDatum::Egm96;
    int columns = 0;
    int rows = 0;
    double spacing_deg = 0.0;  ///< the finer of the two axes
    std::uint64_t voids = 0;   ///< void posts in the file
    std::vector<std::string> notes;
};

/// Heights on the posts of a raster, rows from the first line of the file (usually the north).
struct HeightGrid {
    int columns = 0;
    int rows = 0;
    std::vector<float> heights_m;  ///< kVoid where there is none
    GridMapping mapping;
    double spacing_deg = 0.0;
    std::vector<FileFacts> files;  ///< in the order of the command line
    std::size_t order = 0;         ///< place on the command line of its first file

    [[nodiscard]] std::size_t index(int column, int row) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
               static_cast<std::size_t>(column);
    }
    [[nodiscard]] bool holds(int column, int row) const {
        return column >= 0 && row >= 0 && column < columns && row < rows;
    }
    /// Columns of the full turn if the grid goes round the Earth, else 0.
    [[nodiscard]] int columns_around() const {
        const int around = mapping.columns_around();
        return around > 0 && columns >= around ? around : 0;
    }
};

/// The finer of a grid's two post spacings, degrees, at its middle.
[[nodiscard]] double spacing_at_middle_deg(const GridMapping& mapping, int columns, int rows);

/// Bounds of a grid's posts and half a post around them, from its outline; east may exceed 180 so that east >
/// west.
[[nodiscard]] terrain::GeographicExtent bounds_of(const GridMapping& mapping, int columns, int rows);

/// Whether two extents meet, touching edges included, in some turn of longitude.
[[nodiscard]] bool meet(const terrain::GeographicExtent& a, const terrain::GeographicExtent& b);

/// The place that a latitude past a pole and a longitude of any turn mean; longitude in -180..180, 180
/// excluded. At a pole the longitude is 0, so that a pole is one place.
[[nodiscard]] LatLon normalised(double latitude_deg, double longitude_deg);

/// Joins grids that lie on one lattice and touch or overlap into one grid each, so that no seam is left
/// between them: where they overlap, the first in order that has a height gives it. Grids that stand alone
/// come through unchanged. A pair is left apart where joining would leave a grid more than half empty.
[[nodiscard]] std::vector<HeightGrid> join_neighbours(std::vector<HeightGrid> grids);

}  // namespace eyepoint::tools
