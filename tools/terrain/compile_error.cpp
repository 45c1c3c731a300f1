#include "tools/terrain/compile_error.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "terrain/geodesy/earth.hpp"

namespace eyepoint::tools {

using namespace terrain;

namespace {

/// Not less than any radius of curvature of WGS84 (at the poles, 6399593.6 m) nor, by half a per mille, than
/// the change of the meridional one adds.
constexpr double kGreatestRadiusM = 6.4e6;
/// Above the rounding of double arithmetic on ECEF coordinates and of heights to float.
constexpr double kRoundingM = 1e-6;

Ecef post_ecef(const BlockData& block, int row, int column) {
    return to_ecef({post_latitude_deg(block.tile, row), post_longitude_deg(block.tile, column),
                    EllipsoidalHeight{block.height_m(row, column)}});
}

std::vector<Ecef> posts_ecef(const BlockData& block) {
    std::vector<Ecef> points;
    points.reserve(std::size_t{kBlockPosts} * kBlockPosts);
    for (int row = 0; row < kBlockPosts; ++row) {
        for (int column = 0; column < kBlockPosts; ++column) points.push_back(post_ecef(block, row, column));
    }
    return points;
}

/// Two flat triangles over a cell, split from south-west to north-east.
struct FlatCell {
    Ecef sw, se, nw, ne;

    /// u east, v north, 0..1.
    [[nodiscard]] Ecef at(double u, double v) const {
        return u >= v ? sw + u * (se - sw) + v * (ne - se) : sw + v * (nw - sw) + u * (ne - nw);
    }
};

/// Greatest distance of the posts of rows south..south+span and columns west..west+span from the cell, in
/// which the block's post (row, column) lies at u = (column + east_offset) / side, v = (row + north_offset) /
/// side.
struct CellWindow {
    int south, west, span;
    double north_offset, east_offset, side;
};
double greatest_distance(const std::vector<Ecef>& posts, const FlatCell& cell, const CellWindow& window) {
    double greatest_square = 0.0;
    for (int row = window.south; row <= window.south + window.span; ++row) {
        const double v = (row + window.north_offset) / window.side;
        for (int column = window.west; column <= window.west + window.span; ++column) {
            const double u = (column + window.east_offset) / window.side;
            const Ecef gap = posts[static_cast<std::size_t>(row * kBlockPosts + column)] - cell.at(u, v);
            greatest_square = std::max(greatest_square, gap.x * gap.x + gap.y * gap.y + gap.z * gap.z);
        }
    }
    return std::sqrt(greatest_square);
}

double level_error(const std::vector<Ecef>& posts, int level) {
    const int stride = 1 << level;
    const auto post = [&posts](int row, int column) {
        return posts[static_cast<std::size_t>(row * kBlockPosts + column)];
    };
    double greatest = 0.0;
    for (int row = 0; row < kBlockCells; row += stride) {
        for (int column = 0; column < kBlockCells; column += stride) {
            const FlatCell cell{post(row, column), post(row, column + stride), post(row + stride, column),
                                post(row + stride, column + stride)};
            greatest = std::max(
                greatest, greatest_distance(posts, cell,
                                            {row, column, stride, -static_cast<double>(row),
                                             -static_cast<double>(column), static_cast<double>(stride)}));
        }
    }
    return greatest;
}

Ecef corner_ecef(const TileCorners& corners, int corner) {
    return to_ecef({post_latitude_deg(corners.tile, corner / 2 * kBlockCells),
                    post_longitude_deg(corners.tile, corner % 2 * kBlockCells),
                    EllipsoidalHeight{corners.heights_m[static_cast<std::size_t>(corner)]}});
}

/// The ancestor's whole side as one cell: its level 5.
double ancestor_error(const std::vector<Ecef>& posts, TileId leaf, const TileCorners& above) {
    const std::uint32_t generations = leaf.depth - above.tile.depth;
    const std::uint32_t first_x = above.tile.x << generations;
    const std::uint32_t first_y = above.tile.y << generations;
    const FlatCell cell{corner_ecef(above, 0), corner_ecef(above, 1), corner_ecef(above, 2),
                        corner_ecef(above, 3)};
    return greatest_distance(posts, cell,
                             {0, 0, kBlockCells, static_cast<double>(leaf.y - first_y) * kBlockCells,
                              static_cast<double>(leaf.x - first_x) * kBlockCells,
                              std::ldexp(kBlockCells, static_cast<int>(generations))});
}

float rounded_up(double value) {
    return std::nextafter(static_cast<float>(value), std::numeric_limits<float>::infinity());
}

float greatest_cell_range_m(const BlockData& leaf) {
    float greatest = 0.0F;
    for (int row = 0; row < kBlockCells; ++row) {
        for (int column = 0; column < kBlockCells; ++column) {
            const auto [low, high] =
                std::minmax({leaf.height_m(row, column), leaf.height_m(row, column + 1),
                             leaf.height_m(row + 1, column), leaf.height_m(row + 1, column + 1)});
            greatest = std::max(greatest, high - low);
        }
    }
    return greatest;
}

std::pair<float, float> height_range_m(const BlockData& block) {
    float low = block.height_m(0, 0);
    float high = low;
    for (int row = 0; row < kBlockPosts; ++row) {
        for (int column = 0; column < kBlockPosts; ++column) {
            low = std::min(low, block.height_m(row, column));
            high = std::max(high, block.height_m(row, column));
        }
    }
    return {low, high};
}

}  // namespace

void SurfaceBounds::merge(const SurfaceBounds& other) {
    height_min_m = std::min(height_min_m, other.height_min_m);
    height_max_m = std::max(height_max_m, other.height_max_m);
    std::ranges::transform(error_m, other.error_m, error_m.begin(),
                           [](double a, double b) { return std::max(a, b); });
}

double sagitta_m(const BlockData& leaf) {
    const double cell = post_spacing_deg(leaf.tile.depth) * std::numbers::pi / 180.0;
    const double radius = kGreatestRadiusM + std::max(0.0, static_cast<double>(height_range_m(leaf).second));
    return radius * cell * cell / 8.0 * (1.0 + std::sqrt(5.0)) +
           greatest_cell_range_m(leaf) * cell / std::sqrt(8.0) + kRoundingM;
}

SurfaceBounds leaf_bounds(const BlockData& leaf, const std::vector<TileCorners>& ancestors) {
    SurfaceBounds bounds;
    std::tie(bounds.height_min_m, bounds.height_max_m) = height_range_m(leaf);
    const double sagitta = sagitta_m(leaf);
    const auto posts = posts_ecef(leaf);
    const auto finest = leaf.tile.depth + kBlockLevels - 1;
    bounds.error_m[finest] = sagitta;
    for (int level = 1; level < kBlockLevels; ++level) {
        bounds.error_m[finest - static_cast<std::uint32_t>(level)] = level_error(posts, level) + sagitta;
    }
    for (const TileCorners& above : ancestors) {
        bounds.error_m[above.tile.depth] = ancestor_error(posts, leaf.tile, above) + sagitta;
    }
    return bounds;
}

NodeInfo node_info(TileId tile, const SurfaceBounds& below) {
    NodeInfo info;
    info.height_min_m = below.height_min_m;
    info.height_max_m = below.height_max_m;
    double greatest = 0.0;
    for (std::uint32_t level = 0; level < kBlockLevels; ++level) {
        greatest = std::max(greatest, below.error_m[tile.depth + kBlockLevels - 1 - level]);
        info.delta_m[level] = rounded_up(greatest);
    }
    return info;
}

}  // namespace eyepoint::tools
