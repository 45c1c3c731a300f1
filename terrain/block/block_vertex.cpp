#include "terrain/block/block_vertex.hpp"

#include <algorithm>
#include <cmath>

#include <GeographicLib/Geocentric.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "terrain/geodesy/earth.hpp"

namespace eyepoint::terrain {

namespace {

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

/// BlockVertex::rest of a vertex that stays.
std::uint32_t rest_bits(double msl_m) {
    constexpr double kMost = (1U << (32 - BlockVertex::kHeightShift)) - 1U;
    const double metres = std::clamp(msl_m - kSurfaceFloorM, 0.0, kMost);
    return BlockVertex{}.rest | static_cast<std::uint32_t>(metres + 0.5) << BlockVertex::kHeightShift;
}

/// Only what is on an edge has an edge's place.
std::uint32_t place_bits(std::uint32_t x, std::uint32_t y) {
    const auto rounded = [](std::uint32_t units) {
        constexpr std::uint32_t kStep = kPlaceUnits / kVertexPlaceUnits;
        return std::max(units / kStep, std::min(units, 1U));
    };
    return rounded(x) | rounded(y) << 16;
}

}  // namespace

VertexMaker::VertexMaker(const BlockData& data) : data_(data) {
    for (int i = 0; i < kBlockPosts; ++i) {
        const auto at = static_cast<std::size_t>(i);
        parallels_[at] = parallel_at(post_latitude_deg(data.tile, i), rotation_);
        meridians_[at] = meridian_at(post_longitude_deg(data.tile, i), rotation_);
    }
    fine_parallel_ = parallels_[0];
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
    return {high, low,
            place_bits(static_cast<std::uint32_t>(column) * kUnitsAPost,
                       static_cast<std::uint32_t>(row) * kUnitsAPost),
            rest_bits(msl_m)};
}

BlockVertex VertexMaker::at_fine_post(const NestedMesh::FinePost& post) {
    if (post.y != fine_y_) {
        fine_y_ = post.y;
        fine_parallel_ = parallel_at(fine_latitude_deg(data_.tile, post.y), rotation_);
    }
    const Meridian meridian = meridian_at(fine_longitude_deg(data_.tile, post.x), rotation_);
    const double across = static_cast<double>(post.x) / kUnitsAPost,
                 up = static_cast<double>(post.y) / kUnitsAPost;
    const auto [high, low] = split(position(fine_parallel_, meridian, post.height_m));
    const double msl_m = post.height_m - undulation_m(up / kBlockCells, across / kBlockCells);
    return {high, low, place_bits(post.x, post.y), rest_bits(msl_m)};
}

}  // namespace eyepoint::terrain
