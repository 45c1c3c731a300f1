#include "tools/terrain/nest/first_levels.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <vector>

#include <tbb/parallel_for.h>

#include "terrain/lod/error_level.hpp"

namespace eyepoint::tools {

using namespace terrain;

namespace {

/// Share of the children's posts that the tile's grid must come close to, and how close, in errors of the
/// level.
constexpr double kShare = 0.98;
constexpr double kRoughness = 1.3;
/// Sides of triangles, in posts' spacings of the tile, that leave no more of them than its grid has.
constexpr double kSideSpacings = 2.0;
constexpr double kMetresADegree = 111.4e3;
/// At least: a rough spot in a flat country, a smaller and smaller share of ever larger tiles, must thin out
/// on the way.
constexpr int kLevelsADepth = 2;

/// How far a child's posts that are not the parent's lie from the parent's grid, metres. A child's even posts
/// are the parent's, so the child alone knows.
void append_deviations(const BlockData& child, std::vector<float>& deviations) {
    const auto mean = [&](int row_a, int column_a, int row_b, int column_b) {
        return (child.height_m(row_a, column_a) + child.height_m(row_b, column_b)) / 2.0F;
    };
    for (int row = 0; row < kBlockPosts; ++row) {
        for (int column = 0; column < kBlockPosts; ++column) {
            const int odd_row = row & 1, odd_column = column & 1;
            if (odd_row == 0 && odd_column == 0) continue;
            const float grid = mean(row - odd_row, column - odd_column, row + odd_row, column + odd_column);
            deviations.push_back(std::abs(child.height_m(row, column) - grid));
        }
    }
}

class Survey {
  public:
    explicit Survey(const Database& heights) : heights_(heights) {}

    /// Surveys a tile and everything below it; its block's deviations from its parent are appended.
    std::uint8_t visit(TileId tile, std::vector<float>& from_parent) {
        const auto block = heights_.read_block(tile);
        if (!block) {
            const std::scoped_lock lock(mutex_);
            if (failure_.empty()) failure_ = block.error();
            return 0;
        }
        append_deviations(*block, from_parent);
        std::uint8_t level = bare_level(tile);
        if (heights_.find(tile)->has_children) level = std::max(level, above_children(tile));
        const std::scoped_lock lock(mutex_);
        levels_[tile] = level;
        return level;
    }

    tl::expected<FirstLevels, std::string> take() {
        if (!failure_.empty()) return tl::unexpected(failure_);
        return std::move(levels_);
    }

  private:
    std::uint8_t above_children(TileId tile) {
        std::array<std::uint8_t, 4> below{};
        std::array<std::vector<float>, 4> deviations;
        tbb::parallel_for(std::size_t{0}, std::size_t{4}, [&](std::size_t i) {
            below[i] = visit(child(tile, static_cast<int>(i)), deviations[i]);
        });
        std::vector<float> all;
        for (const auto& part : deviations) all.insert(all.end(), part.begin(), part.end());
        if (all.empty()) return 0;
        const auto at = static_cast<std::ptrdiff_t>(kShare * static_cast<double>(all.size()));
        std::nth_element(all.begin(), all.begin() + at, all.end());
        const auto by_relief =
            level_of_error(kRoughness * static_cast<double>(all[static_cast<std::size_t>(at)]));
        const auto by_children =
            static_cast<std::uint8_t>(*std::max_element(below.begin(), below.end()) + kLevelsADepth);
        const std::uint8_t by_size =
            is_polar(tile) ? std::uint8_t{0}
                           : level_of_reach(kSideSpacings * kMetresADegree * post_spacing_deg(tile.depth));
        return std::min(std::max({by_relief, by_children, by_size}), kLastLevel);
    }

    const Database& heights_;
    std::mutex mutex_;
    FirstLevels levels_;
    std::string failure_;
};

}  // namespace

tl::expected<FirstLevels, std::string> first_levels(const Database& heights) {
    Survey survey{heights};
    tbb::parallel_for(0U, 2U, [&](std::uint32_t x) {
        std::vector<float> unused;
        (void)survey.visit({0, x, 0}, unused);
    });
    return survey.take();
}

}  // namespace eyepoint::tools
