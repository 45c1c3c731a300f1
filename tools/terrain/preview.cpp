#include "tools/terrain/preview.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "terrain/geodesy/earth.hpp"

namespace eyepoint::tools {

using namespace terrain;

namespace {

/// The picture's pixels as places and heights.
struct Raster {
    GeographicExtent extent;
    int width = 0;
    int height = 0;
    std::vector<float> msl_m;
    std::vector<std::uint8_t> water;

    [[nodiscard]] double step_east_deg() const { return (extent.east_deg - extent.west_deg) / width; }
    [[nodiscard]] double step_north_deg() const { return (extent.north_deg - extent.south_deg) / height; }
    [[nodiscard]] float at(int row, int column) const {
        const int r = std::clamp(row, 0, height - 1), c = std::clamp(column, 0, width - 1);
        return msl_m[static_cast<std::size_t>(r * width + c)];
    }
};

Raster raster_over(const GeographicExtent& extent, int longest_px) {
    const double middle = (extent.south_deg + extent.north_deg) / 2.0 * std::numbers::pi / 180.0;
    const double wide = (extent.east_deg - extent.west_deg) * std::max(0.05, std::cos(middle));
    const double high = extent.north_deg - extent.south_deg;
    const double scale = longest_px / std::max(wide, high);
    Raster raster{extent,
                  std::max(1, static_cast<int>(std::lround(wide * scale))),
                  std::max(1, static_cast<int>(std::lround(high * scale))),
                  {},
                  {}};
    raster.msl_m.resize(static_cast<std::size_t>(raster.width) * static_cast<std::size_t>(raster.height));
    raster.water.resize(raster.msl_m.size());
    return raster;
}

float bilinear(float sw, float se, float nw, float ne, float u, float v) {
    return (sw * (1.0F - u) + se * u) * (1.0F - v) + (nw * (1.0F - u) + ne * u) * v;
}

/// The pixels of a raster line whose centres lie in low..high.
struct PixelSpan {
    int first, end;
};
PixelSpan pixels_in(double low, double high, double origin, double step, int count) {
    return {std::clamp(static_cast<int>(std::ceil((low - origin) / step - 0.5)), 0, count),
            std::clamp(static_cast<int>(std::ceil((high - origin) / step - 0.5)), 0, count)};
}

void paint_block(Raster& raster, const BlockData& block) {
    const auto sides = extent(block.tile);
    const double spacing = post_spacing_deg(block.tile.depth);
    const auto rows = pixels_in(-sides.north_deg, -sides.south_deg, -raster.extent.north_deg,
                                raster.step_north_deg(), raster.height);
    const auto columns = pixels_in(sides.west_deg, sides.east_deg, raster.extent.west_deg,
                                   raster.step_east_deg(), raster.width);
    const auto [sw, se, nw, ne] = block.undulation_m;
    for (int row = rows.first; row < rows.end; ++row) {
        const double north =
            (raster.extent.north_deg - (row + 0.5) * raster.step_north_deg() - sides.south_deg) / spacing;
        for (int column = columns.first; column < columns.end; ++column) {
            const double east =
                (raster.extent.west_deg + (column + 0.5) * raster.step_east_deg() - sides.west_deg) / spacing;
            const int r = std::clamp(static_cast<int>(north), 0, kBlockCells - 1);
            const int c = std::clamp(static_cast<int>(east), 0, kBlockCells - 1);
            const float height = bilinear(block.height_m(r, c), block.height_m(r, c + 1),
                                          block.height_m(r + 1, c), block.height_m(r + 1, c + 1),
                                          static_cast<float>(east - c), static_cast<float>(north - r));
            const auto pixel = static_cast<std::size_t>(row * raster.width + column);
            raster.msl_m[pixel] = height - bilinear(sw, se, nw, ne, static_cast<float>(east / kBlockCells),
                                                    static_cast<float>(north / kBlockCells));
            raster.water[pixel] =
                block.water[static_cast<std::size_t>(std::lround(north) * kBlockPosts + std::lround(east))];
        }
    }
}

/// Paints the tiles below, down to the first whose posts are as close as the pixels.
tl::expected<void, std::string> paint(Raster& raster, const Database& database, TileId tile) {
    const auto sides = extent(tile);
    const auto& wanted = raster.extent;
    if (sides.east_deg <= wanted.west_deg || sides.west_deg >= wanted.east_deg ||
        sides.north_deg <= wanted.south_deg || sides.south_deg >= wanted.north_deg) {
        return {};
    }
    const auto* node = database.find(tile);
    if (node->has_children && post_spacing_deg(tile.depth) > raster.step_north_deg()) {
        for (int i = 0; i < 4; ++i) {
            if (auto done = paint(raster, database, child(tile, i)); !done) return done;
        }
        return {};
    }
    const auto block = database.read_block(tile);
    if (!block) return tl::unexpected(block.error());
    paint_block(raster, *block);
    return {};
}

struct Tint {
    float msl_m;
    glm::vec3 colour;
};
constexpr std::array<Tint, 8> kTints{{{0.0F, {0.42F, 0.55F, 0.33F}},
                                      {300.0F, {0.50F, 0.61F, 0.37F}},
                                      {800.0F, {0.64F, 0.68F, 0.44F}},
                                      {1400.0F, {0.72F, 0.68F, 0.49F}},
                                      {2100.0F, {0.66F, 0.58F, 0.48F}},
                                      {2700.0F, {0.70F, 0.67F, 0.64F}},
                                      {3200.0F, {0.88F, 0.88F, 0.90F}},
                                      {4200.0F, {0.98F, 0.98F, 1.00F}}}};
constexpr glm::vec3 kWater{0.30F, 0.47F, 0.62F};

glm::vec3 tint(float msl_m) {
    const auto above =
        std::ranges::find_if(kTints, [msl_m](const Tint& entry) { return entry.msl_m > msl_m; });
    if (above == kTints.begin()) return above->colour;
    if (above == kTints.end()) return kTints.back().colour;
    const Tint& below = *(above - 1);
    return glm::mix(below.colour, above->colour, (msl_m - below.msl_m) / (above->msl_m - below.msl_m));
}

/// Hill shading, 0..1, from the north-west, 40 degrees up, with some light from above.
float shade(const Raster& raster, int row, int column) {
    const double latitude = raster.extent.north_deg - (row + 0.5) * raster.step_north_deg();
    const double north_m = 2.0 * raster.step_north_deg() * kMetresPerDegree;
    const double east_m = 2.0 * raster.step_east_deg() * kMetresPerDegree *
                          std::max(0.02, std::cos(latitude * std::numbers::pi / 180.0));
    const double exaggeration = std::max(1.0, std::sqrt(north_m / 400.0));
    const double east = (raster.at(row, column + 1) - raster.at(row, column - 1)) / east_m * exaggeration;
    const double north = (raster.at(row - 1, column) - raster.at(row + 1, column)) / north_m * exaggeration;
    const glm::dvec3 normal = glm::normalize(glm::dvec3{-east, -north, 1.0});
    const glm::dvec3 light{-0.542, 0.542, 0.643};
    return static_cast<float>(0.2 * normal.z + 0.8 * std::max(0.0, glm::dot(normal, light)) / light.z);
}

}  // namespace

tl::expected<ReliefPicture, std::string> draw_relief(const Database& database, const GeographicExtent& wanted,
                                                     int longest_px) {
    Raster raster = raster_over(wanted, longest_px);
    for (const std::uint32_t x : {0U, 1U}) {
        if (auto done = paint(raster, database, {0, x, 0}); !done) return tl::unexpected(done.error());
    }
    ReliefPicture picture{raster.width, raster.height, {}};
    picture.rgb.reserve(raster.msl_m.size() * 3);
    for (int row = 0; row < raster.height; ++row) {
        for (int column = 0; column < raster.width; ++column) {
            const bool wet = raster.water[static_cast<std::size_t>(row * raster.width + column)] != 0;
            const glm::vec3 base = wet ? kWater : tint(raster.at(row, column));
            const glm::vec3 lit = base * (wet ? 1.0F : shade(raster, row, column));
            for (int channel = 0; channel < 3; ++channel) {
                picture.rgb.push_back(
                    static_cast<std::uint8_t>(std::lround(255.0F * std::clamp(lit[channel], 0.0F, 1.0F))));
            }
        }
    }
    return picture;
}

}  // namespace eyepoint::tools
