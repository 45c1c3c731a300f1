#include "tools/terrain/void_fill.hpp"

#include <algorithm>
#include <array>
#include <numbers>

#include "tools/terrain/mosaic_distance.hpp"
#include "tools/terrain/void_fill_plate.hpp"
#include "tools/terrain/void_fill_relief.hpp"

namespace eyepoint::tools {

namespace {

/// Weight of the membrane beside the plate: it takes over at voids wider than about 30 posts and keeps the
/// plate from swinging out.
constexpr float kTension = 0.03F;
/// Relief beside the ground's own roughness: the plate carries part of it in from the rim.
constexpr double kReliefShare = 0.6;
/// Posts around a void that are looked at for its roughness.
constexpr int kSurroundings = 8;

struct Void {
    std::vector<std::array<int, 2>> posts;  ///< column, row
    float deepest = 0.0F;                   ///< posts from the rim
    std::size_t at_rim = 0;                 ///< of its posts, those beside a height
    std::size_t at_edge = 0;                ///< those on the grid's edge

    /// Bounded by heights far more than by the grid's edge.
    [[nodiscard]] bool enclosed() const { return at_edge * 2 <= at_rim; }
};

/// 8-connected areas of void posts.
std::vector<Void> find_voids(const HeightGrid& grid, std::span<const float> distance) {
    std::vector<Void> voids;
    std::vector<std::uint8_t> seen(grid.heights_m.size(), 0);
    const auto visit = [&](Void& area, int column, int row) {
        if (!grid.holds(column, row)) return;
        const std::size_t post = grid.index(column, row);
        if (seen[post] != 0 || !is_void(grid.heights_m[post])) return;
        seen[post] = 1;
        area.posts.push_back({column, row});
        area.deepest = std::max(area.deepest, distance[post]);
        const bool at_edge = column == 0 || row == 0 || column == grid.columns - 1 || row == grid.rows - 1;
        area.at_edge += at_edge ? 1 : 0;
        area.at_rim += distance[post] < 1.5F ? 1 : 0;
    };
    for (int row = 0; row < grid.rows; ++row) {
        for (int column = 0; column < grid.columns; ++column) {
            Void area;
            visit(area, column, row);
            for (std::size_t next = 0; next < area.posts.size(); ++next) {
                const auto [c, r] = area.posts[next];
                for (int step = 0; step < 9; ++step) visit(area, c + step % 3 - 1, r + step / 3 - 1);
            }
            if (!area.posts.empty()) voids.push_back(std::move(area));
        }
    }
    return voids;
}

/// One void with the posts around it, as the plate's problem.
class Patch {
  public:
    Patch(const HeightGrid& grid, const Void& area) : grid_(grid), area_(area) {
        auto [column, row] = area.posts.front();
        int end_column = column;
        int end_row = row;
        for (const auto& [c, r] : area.posts) {
            column = std::min(column, c);
            end_column = std::max(end_column, c);
            row = std::min(row, r);
            end_row = std::max(end_row, r);
        }
        column_ = column - kSurroundings;
        row_ = row - kSurroundings;
        columns_ = end_column - column + 1 + 2 * kSurroundings;
        rows_ = end_row - row + 1 + 2 * kSurroundings;
        posts_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
        for (std::size_t i = 0; i < area.posts.size(); ++i) {
            posts_[local(area.posts[i][0], area.posts[i][1])].unknown = static_cast<int>(i);
        }
        find_rim();
    }

    /// Root mean square second difference over 2 posts of the ground around.
    [[nodiscard]] double roughness_m() const {
        double sum = 0.0;
        std::size_t count = 0;
        const auto add = [&](float before, float here, float after) {
            const double bend = static_cast<double>(before) - 2.0 * here + after;
            if (std::isnan(bend)) return;
            sum += bend * bend;
            ++count;
        };
        for (int row = row_; row < row_ + rows_; ++row) {
            for (int column = column_; column < column_ + columns_; ++column) {
                add(height(column - 2, row), height(column, row), height(column + 2, row));
                add(height(column, row - 2), height(column, row), height(column, row + 2));
            }
        }
        return count == 0 ? 0.0 : std::sqrt(sum / static_cast<double>(count));
    }

    /// Whether the void lies in the sea: nearly all of its rim is exactly 0.
    [[nodiscard]] bool in_flat_sea() const {
        const auto zeros = std::count_if(rim_.begin(), rim_.end(),
                                         [&](const auto& post) { return height(post[0], post[1]) == 0.0F; });
        return !rim_.empty() && zeros * 10 >= static_cast<std::ptrdiff_t>(rim_.size()) * 9;
    }

    /// Heights for the void's posts, in their order.
    [[nodiscard]] std::vector<float> filled(const CoarserSurface& coarser) {
        const std::vector<float> rim_shape = shape_at(rim_, coarser);
        const std::vector<float> void_shape = shape_at(area_.posts, coarser);
        double mean = 0.0;
        for (std::size_t i = 0; i < rim_.size(); ++i) {
            const float delta = height(rim_[i][0], rim_[i][1]) - rim_shape[i];
            posts_[local(rim_[i][0], rim_[i][1])] = {ThinPlate::kKnown, delta};
            mean += delta / static_cast<double>(rim_.size());
        }
        const std::vector<double> deltas = plate().solve(std::vector<double>(area_.posts.size(), mean));
        std::vector<float> heights = void_shape;
        for (std::size_t i = 0; i < heights.size(); ++i) heights[i] += static_cast<float>(deltas[i]);
        return heights;
    }

  private:
    [[nodiscard]] std::size_t local(int column, int row) const {
        return static_cast<std::size_t>(row - row_) * static_cast<std::size_t>(columns_) +
               static_cast<std::size_t>(column - column_);
    }
    [[nodiscard]] float height(int column, int row) const {
        return grid_.holds(column, row) ? grid_.heights_m[grid_.index(column, row)] : kVoid;
    }

    /// Known posts within 2 of the void: all that its plate touches.
    void find_rim() {
        std::vector<std::uint8_t> taken(posts_.size(), 0);
        for (const auto& [column, row] : area_.posts) {
            for (int step = 0; step < 25; ++step) {
                const int c = column + step % 5 - 2;
                const int r = row + step / 5 - 2;
                if (is_void(height(c, r)) || taken[local(c, r)] != 0) continue;
                taken[local(c, r)] = 1;
                rim_.push_back({c, r});
            }
        }
    }

    [[nodiscard]] std::vector<float> shape_at(const std::vector<std::array<int, 2>>& posts,
                                              const CoarserSurface& coarser) const {
        std::vector<float> shape(posts.size(), 0.0F);
        if (coarser) {
            std::vector<GridPosition> positions;
            positions.reserve(posts.size());
            for (const auto& [column, row] : posts) {
                positions.push_back({static_cast<double>(column), static_cast<double>(row)});
            }
            shape = coarser(positions);
        }
        const auto roughness = static_cast<float>(kReliefShare * roughness_m());
        for (std::size_t i = 0; i < posts.size(); ++i)
            shape[i] += roughness * ridged_relief(posts[i][0], posts[i][1]);
        return shape;
    }

    [[nodiscard]] ThinPlate plate() const {
        static constexpr std::array kBend{1.0F, -2.0F, 1.0F};
        static constexpr auto kRoot2 = std::numbers::sqrt2_v<float>;
        static constexpr std::array kTwist{kRoot2, -kRoot2, -kRoot2, kRoot2};
        static constexpr std::array kStretch{kTension, -kTension};
        ThinPlate plate{area_.posts.size()};
        const auto at = [&](int column, int row) { return posts_[local(column, row)]; };
        for (int row = row_ + 2; row < row_ + rows_ - 2; ++row) {
            for (int column = column_ + 2; column < column_ + columns_ - 2; ++column) {
                plate.add(std::array{at(column - 1, row), at(column, row), at(column + 1, row)}, kBend);
                plate.add(std::array{at(column, row - 1), at(column, row), at(column, row + 1)}, kBend);
                plate.add(std::array{at(column, row), at(column + 1, row), at(column, row + 1),
                                     at(column + 1, row + 1)},
                          kTwist);
                plate.add(std::array{at(column, row), at(column + 1, row)}, kStretch);
                plate.add(std::array{at(column, row), at(column, row + 1)}, kStretch);
            }
        }
        return plate;
    }

    const HeightGrid& grid_;
    const Void& area_;
    int column_ = 0;
    int row_ = 0;
    int columns_ = 0;
    int rows_ = 0;
    std::vector<ThinPlate::Post> posts_;
    std::vector<std::array<int, 2>> rim_;
};

}  // namespace

float deepest_void_posts(double spacing_deg, bool enclosed) {
    constexpr double kMostPosts = 64.0;
    constexpr double kMostDeg = 0.1;
    constexpr double kLeastPosts = 3.0;
    constexpr double kEnclosedFactor = 3.0;
    const double posts = std::max(kLeastPosts, std::min(kMostPosts, kMostDeg / spacing_deg));
    return static_cast<float>(enclosed ? kEnclosedFactor * posts : posts);
}

VoidFill fill_voids(HeightGrid& grid, const CoarserSurface& coarser) {
    std::vector<std::uint8_t> known(grid.heights_m.size());
    std::transform(grid.heights_m.begin(), grid.heights_m.end(), known.begin(),
                   [](float height) { return is_void(height) ? 0 : 1; });
    if (std::find(known.begin(), known.end(), std::uint8_t{0}) == known.end()) return {};
    VoidFill result;
    for (const Void& area : find_voids(grid, distance_to_sites(known, grid.columns, grid.rows))) {
        if (area.deepest > deepest_void_posts(grid.spacing_deg, area.enclosed())) {
            result.outside += area.posts.size();
            continue;
        }
        Patch patch{grid, area};
        const std::vector<float> heights =
            patch.in_flat_sea() ? std::vector<float>(area.posts.size(), 0.0F) : patch.filled(coarser);
        for (std::size_t i = 0; i < heights.size(); ++i) {
            grid.heights_m[grid.index(area.posts[i][0], area.posts[i][1])] = heights[i];
        }
        result.filled += area.posts.size();
    }
    return result;
}

}  // namespace eyepoint::tools
