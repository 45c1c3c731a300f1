#include "terrain/block/block_vertex.hpp"

#include <algorithm>
#include <cmath>

#include <GeographicLib/Geocentric.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "terrain/geodesy/earth.hpp"

namespace eyepoint::terrain {

namespace {

/// Metres per degree along the meridian and the parallel, on the sphere of the semi-major axis: good to 1%,
/// which a shading normal does not show.
constexpr double kMetresPerDegree = kEquatorialRadiusM * 3.14159265358979323846 / 180.0;
/// No parallel is taken for shorter than this share of the equator: slopes at a pole stay finite.
constexpr double kLeastCosine = 1e-3;
constexpr std::uint32_t kUnitsAPost = kPlaceUnits / std::uint32_t{kBlockCells};

/// GeographicLib's rotation matrix is row-major; its columns are east, north, up.
Parallel parallel_at(double latitude_deg, std::vector<double>& rotation) {
    Parallel result;
    double across_m = 0.0;
    GeographicLib::Geocentric::WGS84().Forward(latitude_deg, 0.0, 0.0, result.from_axis_m, across_m,
                                               result.from_equator_m, rotation);
    result.sine = rotation[8];
    result.cosine = rotation[2];
    return result;
}

Meridian meridian_at(double longitude_deg, std::vector<double>& rotation) {
    Ecef point;
    GeographicLib::Geocentric::WGS84().Forward(0.0, longitude_deg, 0.0, point.x, point.y, point.z, rotation);
    return {-rotation[0], rotation[3]};
}

double fine_latitude_deg(TileId tile, std::uint32_t y) {
    const std::int64_t units = std::int64_t{tile.y} * kPlaceUnits + y;
    return static_cast<double>(units) * (tile_side_deg(tile.depth) / kPlaceUnits) - 90.0;
}

/// The antimeridian is -180 from both sides, as in post_longitude_deg().
double fine_longitude_deg(TileId tile, std::uint32_t x) {
    const std::int64_t around = std::int64_t{tiles_across(tile.depth)} * kPlaceUnits;
    const std::int64_t units = (std::int64_t{tile.x} * kPlaceUnits + x) % around;
    return static_cast<double>(units) * (tile_side_deg(tile.depth) / kPlaceUnits) - 180.0;
}

/// Adding 0 makes a negative zero positive: the pole has the same bits from every longitude.
Ecef position(const Parallel& parallel, const Meridian& meridian, double height_m) {
    const double from_axis_m = parallel.from_axis_m + height_m * parallel.cosine;
    return {from_axis_m * meridian.cosine + 0.0, from_axis_m * meridian.sine + 0.0,
            parallel.from_equator_m + height_m * parallel.sine + 0.0};
}

std::uint32_t pack_normal(const glm::dvec3& normal) {
    const auto field = [](double value) {
        const double steps = value * 511.0;
        return static_cast<std::uint32_t>(static_cast<int>(steps < 0.0 ? steps - 0.5 : steps + 0.5)) & 0x3ffU;
    };
    return field(normal.x) | (field(normal.y) << 10) | (field(normal.z) << 20);
}

/// Of a surface that rises by so much a metre to the east and to the north.
std::uint32_t normal_bits(const Parallel& parallel, const Meridian& meridian, const glm::dvec2& rise) {
    const glm::dvec3 leaning = glm::normalize(glm::dvec3{-rise.x, -rise.y, 1.0});
    const double outward = leaning.z * parallel.cosine - leaning.y * parallel.sine;
    return pack_normal({outward * meridian.cosine - leaning.x * meridian.sine,
                        outward * meridian.sine + leaning.x * meridian.cosine,
                        leaning.z * parallel.sine + leaning.y * parallel.cosine});
}

std::uint32_t surface_bits(double msl_m, bool water) {
    const double steps = std::clamp((msl_m - kSurfaceFloorM) / kSurfaceStepM, 0.0, 65535.0);
    return static_cast<std::uint32_t>(steps + 0.5) | (water ? 1U << 16 : 0U);
}

std::uint32_t place_bits(std::uint32_t x, std::uint32_t y) {
    constexpr std::uint32_t kStep = kPlaceUnits / kVertexPlaceUnits;
    return x / kStep | (y / kStep) << 16;
}

}  // namespace

VertexMaker::VertexMaker(const BlockData& data)
    : data_(data), per_north_m_(0.5 / (post_spacing_deg(data.tile.depth) * kMetresPerDegree)) {
    for (int i = 0; i < kBlockPosts; ++i) {
        const auto at = static_cast<std::size_t>(i);
        parallels_[at] = parallel_at(post_latitude_deg(data.tile, i), rotation_);
        meridians_[at] = meridian_at(post_longitude_deg(data.tile, i), rotation_);
        per_east_m_[at] = per_north_m_ / std::max(parallels_[at].cosine, kLeastCosine);
    }
    fine_parallel_ = parallels_[0];
}

/// Rise to the east and to the north per metre, from the posts on both sides.
glm::dvec2 VertexMaker::slope(int row, int column) const {
    const double east = data_.height_m(row, column + 1) - data_.height_m(row, column - 1);
    const double north = data_.height_m(row + 1, column) - data_.height_m(row - 1, column);
    return {east * per_east_m_[static_cast<std::size_t>(row)], north * per_north_m_};
}

double VertexMaker::undulation_m(double north, double east) const {
    return (data_.undulation_m[0] * (1.0 - east) + data_.undulation_m[1] * east) * (1.0 - north) +
           (data_.undulation_m[2] * (1.0 - east) + data_.undulation_m[3] * east) * north;
}

BlockVertex VertexMaker::at_post(int row, int column) const {
    const Parallel& parallel = parallels_[static_cast<std::size_t>(row)];
    const Meridian& meridian = meridians_[static_cast<std::size_t>(column)];
    const double height_m = data_.height_m(row, column);
    const auto [high, low] = split(position(parallel, meridian, height_m));
    const double msl_m = height_m - undulation_m(static_cast<double>(row) / kBlockCells,
                                                 static_cast<double>(column) / kBlockCells);
    const bool water = data_.water[static_cast<std::size_t>(row * kBlockPosts + column)] != 0;
    return {high, low, normal_bits(parallel, meridian, slope(row, column)), surface_bits(msl_m, water),
            place_bits(static_cast<std::uint32_t>(column) * kUnitsAPost,
                       static_cast<std::uint32_t>(row) * kUnitsAPost)};
}

BlockVertex VertexMaker::at_fine_post(const NestedMesh::FinePost& post) {
    if (post.y != fine_y_) {
        fine_y_ = post.y;
        fine_parallel_ = parallel_at(fine_latitude_deg(data_.tile, post.y), rotation_);
    }
    const Meridian meridian = meridian_at(fine_longitude_deg(data_.tile, post.x), rotation_);
    const double across = static_cast<double>(post.x) / kUnitsAPost,
                 up = static_cast<double>(post.y) / kUnitsAPost;
    const int column = std::min(static_cast<int>(across), kBlockCells - 1);
    const int row = std::min(static_cast<int>(up), kBlockCells - 1);
    // On a line between posts the posts beside it have weight 0, so tiles on both sides of an edge agree.
    const double east = across - column, north = up - row;
    const glm::dvec2 rise =
        (slope(row, column) * (1.0 - east) + slope(row, column + 1) * east) * (1.0 - north) +
        (slope(row + 1, column) * (1.0 - east) + slope(row + 1, column + 1) * east) * north;
    const auto [high, low] = split(position(fine_parallel_, meridian, post.height_m));
    const double msl_m = post.height_m - undulation_m(up / kBlockCells, across / kBlockCells);
    const int nearest = static_cast<int>(up + 0.5) * kBlockPosts + static_cast<int>(across + 0.5);
    return {high, low, normal_bits(fine_parallel_, meridian, rise),
            surface_bits(msl_m, data_.water[static_cast<std::size_t>(nearest)] != 0),
            place_bits(post.x, post.y)};
}

}  // namespace eyepoint::terrain
