/// Where the posts of a raster lie on the Earth: between latitude and longitude and fractional rows and
/// columns.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <string>

#include <tl/expected.hpp>

#include "terrain/tiling/tile_id.hpp"

class OGRSpatialReference;

namespace eyepoint::tools {

struct LatLon {
    double latitude_deg = 0.0;
    double longitude_deg = 0.0;
};

/// A position in a raster, in posts: (0, 0) is the centre of the first (north-west) pixel, whole numbers are
/// posts.
struct GridPosition {
    double column = 0.0;
    double row = 0.0;
};

/// A raster's georeference: an affine geotransform in a coordinate system, against WGS84 latitude and
/// longitude. Pixel-is-point and pixel-is-area files differ only in the geotransform that GDAL gives: a post
/// is a pixel centre. Geographic rasters in WGS84 (or a datum that PROJ takes as equal) are pure arithmetic,
/// others go through PROJ, per position, without resampling. Positions within 1e-6 of a whole post are that
/// post. Thread use: const use is safe from any thread.
class GridMapping {
  public:
    /// geotransform: GDAL's six numbers. On failure: one sentence without the file's name.
    [[nodiscard]] static tl::expected<GridMapping, std::string> create(
        const std::array<double, 6>& geotransform, const OGRSpatialReference& system);
    /// A WGS84 raster spread over an extent, edge to edge (pixel-is-area).
    [[nodiscard]] static GridMapping spread(const terrain::GeographicExtent& extent, int columns, int rows);

    /// out.size() == places.size(); NaN where the coordinate system does not reach. For geographic rasters
    /// the turn is chosen so that the column is at least -1.
    void to_grid(std::span<const LatLon> places, std::span<GridPosition> out) const;
    [[nodiscard]] GridPosition to_grid(LatLon place) const;
    /// NaN where the coordinate system does not reach. Longitude in any turn.
    [[nodiscard]] LatLon to_place(GridPosition position) const;

    [[nodiscard]] bool is_geographic() const { return transforms_ == nullptr; }
    /// Columns of a full turn; 0 unless the raster is geographic, north up and 360 degrees are whole columns.
    [[nodiscard]] int columns_around() const;
    /// The same mapping with the origin moved by whole posts.
    [[nodiscard]] GridMapping shifted(int columns, int rows) const;
    /// Whole posts from this raster's origin to the other's when both are on one lattice (to 1/100 post).
    struct Offset {
        int columns = 0;
        int rows = 0;
        bool congruent = false;
    };
    [[nodiscard]] Offset offset_of(const GridMapping& other, int columns, int rows) const;

  private:
    class Transforms;
    GridMapping(const std::array<double, 6>& post_transform, std::shared_ptr<Transforms> transforms,
                std::string system);
    void unproject(std::span<double> x, std::span<double> y) const;
    [[nodiscard]] GridPosition from_plane(double x, double y) const;

    std::array<double, 6> forward_{};  ///< post (column, row) to plane x, y
    std::array<double, 6> inverse_{};
    std::shared_ptr<Transforms> transforms_;  ///< null for geographic rasters
    std::string system_;
};

}  // namespace eyepoint::tools
