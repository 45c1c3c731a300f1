#include "terrain/block/block.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "terrain/geodesy/earth.hpp"

namespace eyepoint::terrain {

namespace {

/// Metres per degree along the meridian and the parallel at a latitude, on the sphere of the semi-major axis:
/// good to 1%, which a shading normal does not show.
constexpr double kMetresPerDegree = kEquatorialRadiusM * 3.14159265358979323846 / 180.0;

std::uint32_t pack_normal(const glm::dvec3& normal) {
    const auto field = [](double value) {
        return static_cast<std::uint32_t>(
                   static_cast<int>(std::lround(std::clamp(value, -1.0, 1.0) * 511.0))) &
               0x3ffU;
    };
    return field(normal.x) | (field(normal.y) << 10) | (field(normal.z) << 20);
}

std::uint32_t pack_surface(double msl_m, bool water) {
    const double steps = std::clamp((msl_m - kSurfaceFloorM) / kSurfaceStepM, 0.0, 65535.0);
    return static_cast<std::uint32_t>(std::lround(steps)) | (water ? 1U << 16 : 0U);
}

double undulation_m(const BlockData& data, int row, int column) {
    const double north = static_cast<double>(row) / kBlockCells;
    const double east = static_cast<double>(column) / kBlockCells;
    return (data.undulation_m[0] * (1.0 - east) + data.undulation_m[1] * east) * (1.0 - north) +
           (data.undulation_m[2] * (1.0 - east) + data.undulation_m[3] * east) * north;
}

/// Rise to the east and to the north per metre, from the posts on both sides.
glm::dvec2 slope(const BlockData& data, int row, int column, double latitude_deg) {
    const double spacing_m = post_spacing_deg(data.tile.depth) * kMetresPerDegree;
    const double shrink = std::max(std::cos(latitude_deg * 3.14159265358979323846 / 180.0), 1e-3);
    const double east = data.height_m(row, column + 1) - data.height_m(row, column - 1);
    const double north = data.height_m(row + 1, column) - data.height_m(row - 1, column);
    return {east / (2.0 * spacing_m * shrink), north / (2.0 * spacing_m)};
}

BlockVertex make_vertex(const BlockData& data, int row, int column) {
    const double latitude_deg = post_latitude_deg(data.tile, row);
    const double longitude_deg = post_longitude_deg(data.tile, column);
    const double height_m = data.height_m(row, column);
    const auto position = split(to_ecef({latitude_deg, longitude_deg, EllipsoidalHeight{height_m}}));
    const glm::dvec2 rise = slope(data, row, column, latitude_deg);
    const glm::dvec3 normal =
        east_north_up(latitude_deg, longitude_deg) * glm::normalize(glm::dvec3{-rise.x, -rise.y, 1.0});
    const bool water = data.water[static_cast<std::size_t>(row * kBlockPosts + column)] != 0;
    return {position.high, position.low, pack_normal(normal),
            pack_surface(height_m - undulation_m(data, row, column), water)};
}

}  // namespace

SplitPosition split(const Ecef& point) {
    const glm::vec3 high{point};
    const glm::vec3 low{point - glm::dvec3{high}};
    return {{high.x, high.y, high.z}, {low.x, low.y, low.z}};
}

std::size_t Block::bytes() const {
    return sizeof(Block) + vertices.capacity() * sizeof(BlockVertex) + (image ? image->rgb.capacity() : 0);
}

std::shared_ptr<const Block> unfold(BlockData data, std::optional<ImageData> image) {
    auto block = std::make_shared<Block>();
    block->vertices.reserve(kBlockVertices);
    for (int row = 0; row < kBlockPosts; ++row) {
        for (int column = 0; column < kBlockPosts; ++column)
            block->vertices.push_back(make_vertex(data, row, column));
    }
    block->has_water =
        std::any_of(data.water.begin(), data.water.end(), [](std::uint8_t flag) { return flag != 0; });
    block->data = data;
    block->image = std::move(image);
    return block;
}

}  // namespace eyepoint::terrain
