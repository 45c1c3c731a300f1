#include "terrain/block/relief.hpp"

#include <algorithm>
#include <cmath>

#include "terrain/geodesy/earth.hpp"

namespace eyepoint::terrain {

namespace {

constexpr double kRadians = 3.14159265358979323846 / 180.0;
/// No parallel is taken for shorter than this share of the equator: slopes at a pole stay finite.
constexpr double kLeastCosine = 1e-3;

std::uint32_t component_bits(double value) {
    return static_cast<std::uint32_t>(static_cast<int>(std::lround(value * kReliefUnits))) & 0xfffU;
}

}  // namespace

std::vector<ReliefPost> relief_of(const BlockData& data) {
    std::vector<ReliefPost> posts;
    posts.reserve(static_cast<std::size_t>(kBlockPosts) * kBlockPosts);
    const double per_north_m = 0.5 / (post_spacing_deg(data.tile.depth) * kMetresPerDegree);
    for (int row = 0; row < kBlockPosts; ++row) {
        const double cosine = std::cos(post_latitude_deg(data.tile, row) * kRadians);
        const double per_east_m = per_north_m / std::max(cosine, kLeastCosine);
        for (int column = 0; column < kBlockPosts; ++column) {
            const double east =
                (data.height_m(row, column + 1) - data.height_m(row, column - 1)) * per_east_m;
            const double north =
                (data.height_m(row + 1, column) - data.height_m(row - 1, column)) * per_north_m;
            const double upward = 1.0 / std::sqrt(1.0 + east * east + north * north);
            const bool water = data.water[static_cast<std::size_t>(row * kBlockPosts + column)] != 0;
            posts.push_back(component_bits(-east * upward) | component_bits(-north * upward) << 12 |
                            (water ? 255U << 24 : 0U));
        }
    }
    return posts;
}

}  // namespace eyepoint::terrain
