#include "tools/terrain/gdal_mapping.hpp"

#include <cmath>
#include <limits>
#include <mutex>
#include <vector>

#include <gdal.h>
#include <ogr_spatialref.h>

#include "tools/terrain/gdal_session.hpp"

namespace eyepoint::tools {

struct DestroyTransform {
    void operator()(OGRCoordinateTransformation* transform) const {
        OGRCoordinateTransformation::DestroyCT(transform);
    }
};
using Transform = std::unique_ptr<OGRCoordinateTransformation, DestroyTransform>;

namespace {

/// A tenth of a millimetre on a 90 m raster: what decimal spacings in files lose in a few thousand posts.
constexpr double kSnapPosts = 1e-6;

double snapped(double position) {
    const double whole = std::round(position);
    return std::abs(position - whole) < kSnapPosts ? whole : position;
}

/// Of a geotransform that is known to be invertible.
std::array<double, 6> inverted(std::array<double, 6> forward) {
    std::array<double, 6> inverse{};
    static_cast<void>(GDALInvGeoTransform(forward.data(), inverse.data()) == TRUE);
    return inverse;
}

/// Whether a geographic system's coordinates are WGS84's, to 1e-9 degrees (0.1 mm), at a few places.
bool same_as_wgs84(OGRCoordinateTransformation& to_wgs84) {
    for (const double latitude : {-60.0, -10.0, 35.0, 60.0}) {
        for (const double longitude : {-120.0, 10.0, 140.0}) {
            double x = longitude;
            double y = latitude;
            if (to_wgs84.Transform(1, &x, &y) == FALSE) return false;
            if (std::abs(x - longitude) > 1e-9 || std::abs(y - latitude) > 1e-9) return false;
        }
    }
    return true;
}

OGRSpatialReference wgs84() {
    OGRSpatialReference system;
    system.importFromEPSG(4326);
    system.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    return system;
}

}  // namespace

/// PROJ transforms belong to one thread at a time: a pool that grows to the number of threads asking at once.
class GridMapping::Transforms {
  public:
    struct Pair {
        Transform to_plane;
        Transform to_wgs84;
    };

    explicit Transforms(Pair first) { free_.push_back(std::move(first)); }

    [[nodiscard]] Pair take() {
        const std::scoped_lock lock{mutex_};
        Pair& last = free_.back();
        if (free_.size() == 1) return {Transform{last.to_plane->Clone()}, Transform{last.to_wgs84->Clone()}};
        Pair taken = std::move(last);
        free_.pop_back();
        return taken;
    }

    void give(Pair pair) {
        const std::scoped_lock lock{mutex_};
        free_.push_back(std::move(pair));
    }

  private:
    std::mutex mutex_;
    std::vector<Pair> free_;  ///< never empty
};

GridMapping::GridMapping(const std::array<double, 6>& post_transform, std::shared_ptr<Transforms> transforms,
                         std::string system)
    : forward_(post_transform),
      inverse_(inverted(post_transform)),
      transforms_(std::move(transforms)),
      system_(std::move(system)) {}

tl::expected<GridMapping, std::string> GridMapping::create(const std::array<double, 6>& geotransform,
                                                           const OGRSpatialReference& system) {
    const GdalMessages messages;
    // Local copies without the vertical part, which would ask PROJ for grids: the vertical datum is ours to
    // convert.
    OGRSpatialReference plane{system};
    if (plane.IsCompound()) plane.StripVertical();
    plane.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    const OGRSpatialReference globe = wgs84();
    Transforms::Pair pair{Transform{OGRCreateCoordinateTransformation(&globe, &plane)},
                          Transform{OGRCreateCoordinateTransformation(&plane, &globe)}};
    if (!pair.to_plane || !pair.to_wgs84) {
        return tl::unexpected("its coordinate system cannot be related to WGS84 (" + messages.last() + ")");
    }
    std::array<double, 6> post = geotransform;
    post[0] += 0.5 * (geotransform[1] + geotransform[2]);
    post[3] += 0.5 * (geotransform[4] + geotransform[5]);
    std::array<double, 6> scratch{};
    if (GDALInvGeoTransform(post.data(), scratch.data()) == FALSE) {
        return tl::unexpected(std::string{"its geotransform is degenerate"});
    }
    const bool north_up = geotransform[2] == 0.0 && geotransform[4] == 0.0 && geotransform[1] > 0.0;
    if (north_up && plane.IsGeographic() != FALSE && same_as_wgs84(*pair.to_wgs84))
        return GridMapping{post, nullptr, "geographic"};
    char* text = nullptr;
    plane.exportToWkt(&text);
    const std::string name = text == nullptr ? "" : text;
    CPLFree(text);
    return GridMapping{post, std::make_shared<Transforms>(std::move(pair)), name};
}

GridMapping GridMapping::spread(const terrain::GeographicExtent& extent, int columns, int rows) {
    const double width = (extent.east_deg - extent.west_deg) / columns;
    const double height = (extent.north_deg - extent.south_deg) / rows;
    return GridMapping{
        {extent.west_deg + 0.5 * width, width, 0.0, extent.north_deg - 0.5 * height, 0.0, -height},
        nullptr,
        "geographic"};
}

void GridMapping::unproject(std::span<double> x, std::span<double> y) const {
    const GdalMessages unheard;
    Transforms::Pair pair = transforms_->take();
    std::vector<int> reached(x.size());
    pair.to_plane->Transform(static_cast<int>(x.size()), x.data(), y.data(), nullptr, reached.data());
    transforms_->give(std::move(pair));
    for (std::size_t i = 0; i < x.size(); ++i) {
        if (reached[i] == 0) x[i] = y[i] = std::numeric_limits<double>::quiet_NaN();
    }
}

GridPosition GridMapping::from_plane(double x, double y) const {
    return {snapped(inverse_[0] + inverse_[1] * x + inverse_[2] * y),
            snapped(inverse_[3] + inverse_[4] * x + inverse_[5] * y)};
}

void GridMapping::to_grid(std::span<const LatLon> places, std::span<GridPosition> out) const {
    if (is_geographic()) {
        for (std::size_t i = 0; i < places.size(); ++i) {
            double east_of_first = std::fmod(places[i].longitude_deg - forward_[0], 360.0);
            // Half a cell west of the first post still belongs to it, or is the last column's of a global
            // raster.
            if (east_of_first < -std::abs(forward_[1])) east_of_first += 360.0;
            if (east_of_first > 360.0 - std::abs(forward_[1])) east_of_first -= 360.0;
            out[i] = {snapped(east_of_first / forward_[1]),
                      snapped((places[i].latitude_deg - forward_[3]) / forward_[5])};
        }
        return;
    }
    std::vector<double> x(places.size());
    std::vector<double> y(places.size());
    for (std::size_t i = 0; i < places.size(); ++i) {
        x[i] = places[i].longitude_deg;
        y[i] = places[i].latitude_deg;
    }
    unproject(x, y);
    for (std::size_t i = 0; i < places.size(); ++i) out[i] = from_plane(x[i], y[i]);
}

GridPosition GridMapping::to_grid(LatLon place) const {
    GridPosition position;
    to_grid(std::span{&place, 1}, std::span{&position, 1});
    return position;
}

LatLon GridMapping::to_place(GridPosition position) const {
    double x = forward_[0] + forward_[1] * position.column + forward_[2] * position.row;
    double y = forward_[3] + forward_[4] * position.column + forward_[5] * position.row;
    if (is_geographic()) return {y, x};
    const GdalMessages unheard;
    Transforms::Pair pair = transforms_->take();
    const bool reached = pair.to_wgs84->Transform(1, &x, &y) != FALSE;
    transforms_->give(std::move(pair));
    constexpr double kNowhere = std::numeric_limits<double>::quiet_NaN();
    return reached ? LatLon{y, x} : LatLon{kNowhere, kNowhere};
}

int GridMapping::columns_around() const {
    if (!is_geographic()) return 0;
    const double columns = 360.0 / forward_[1];
    return std::abs(columns - std::round(columns)) < 0.01 ? static_cast<int>(std::lround(columns)) : 0;
}

GridMapping GridMapping::shifted(int columns, int rows) const {
    GridMapping moved{*this};
    moved.forward_[0] += forward_[1] * columns + forward_[2] * rows;
    moved.forward_[3] += forward_[4] * columns + forward_[5] * rows;
    moved.inverse_ = inverted(moved.forward_);
    return moved;
}

GridMapping::Offset GridMapping::offset_of(const GridMapping& other, int columns, int rows) const {
    constexpr double kTolerancePosts = 0.01;
    if (system_ != other.system_) return {};
    const auto plane = [](const GridMapping& mapping, double column, double row) {
        const auto& f = mapping.forward_;
        return std::array{f[0] + f[1] * column + f[2] * row, f[3] + f[4] * column + f[5] * row};
    };
    const auto first = plane(other, 0, 0);
    const auto last = plane(other, columns - 1, rows - 1);
    const GridPosition start = from_plane(first[0], first[1]);
    const GridPosition end = from_plane(last[0], last[1]);
    const double column = std::round(start.column);
    const double row = std::round(start.row);
    const bool near = std::abs(start.column - column) < kTolerancePosts &&
                      std::abs(start.row - row) < kTolerancePosts &&
                      std::abs(end.column - column - (columns - 1)) < kTolerancePosts &&
                      std::abs(end.row - row - (rows - 1)) < kTolerancePosts;
    if (!near || std::abs(column) > 1e8 || std::abs(row) > 1e8) return {};
    return {static_cast<int>(column), static_cast<int>(row), true};
}

}  // namespace eyepoint::tools
