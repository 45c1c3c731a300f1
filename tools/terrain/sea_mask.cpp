#include "tools/terrain/sea_mask.hpp"

#include <array>

namespace eyepoint::tools {

namespace {

/// Grows one connected area of posts at or below 0; marks its posts in `seen` and lists them in `area`.
class LowArea {
  public:
    LowArea(const HeightGrid& grid, std::vector<std::uint8_t>& seen) : grid_(grid), seen_(seen) {}

    void grow_from(int column, int row) {
        visit(column, row);
        for (std::size_t next = 0; next < posts_.size(); ++next) {
            const auto [here_column, here_row] = posts_[next];
            visit(here_column - 1, here_row);
            visit(here_column + 1, here_row);
            visit(here_column, here_row - 1);
            visit(here_column, here_row + 1);
        }
    }

    [[nodiscard]] bool is_sea() const {
        if (lowest_m_ < kLowestDryLandM) return true;
        const bool large = at_border_ || posts_.size() >= kSmallestSeaPosts;
        return large && zeros_ * 2 > posts_.size();
    }
    [[nodiscard]] const std::vector<std::array<int, 2>>& posts() const { return posts_; }

  private:
    void visit(int column, int row) {
        if (const int around = grid_.columns_around(); around > 0) column = (column + around) % around;
        if (!grid_.holds(column, row)) return;
        const std::size_t post = grid_.index(column, row);
        const float height = grid_.heights_m[post];
        if (seen_[post] != 0 || !(height <= 0.0F)) return;
        seen_[post] = 1;
        posts_.push_back({column, row});
        zeros_ += height == 0.0F ? 1 : 0;
        lowest_m_ = std::min(lowest_m_, height);
        at_border_ =
            at_border_ || column == 0 || row == 0 || column == grid_.columns - 1 || row == grid_.rows - 1;
    }

    const HeightGrid& grid_;
    std::vector<std::uint8_t>& seen_;
    std::vector<std::array<int, 2>> posts_;
    std::size_t zeros_ = 0;
    float lowest_m_ = 0.0F;
    bool at_border_ = false;
};

}  // namespace

std::optional<SeaRule> sea_rule_named(std::string_view name) {
    if (name == "auto") return SeaRule::Auto;
    if (name == "none") return SeaRule::None;
    if (name == "clamp") return SeaRule::Clamp;
    return std::nullopt;
}

std::vector<std::uint8_t> find_sea(const HeightGrid& grid, SeaRule rule) {
    std::vector<std::uint8_t> sea(grid.heights_m.size(), 0);
    if (rule == SeaRule::None) return sea;
    if (rule == SeaRule::Clamp) {
        for (std::size_t post = 0; post < sea.size(); ++post)
            sea[post] = grid.heights_m[post] <= 0.0F ? 1 : 0;
        return sea;
    }
    std::vector<std::uint8_t> seen(grid.heights_m.size(), 0);
    for (int row = 0; row < grid.rows; ++row) {
        for (int column = 0; column < grid.columns; ++column) {
            const std::size_t post = grid.index(column, row);
            if (seen[post] != 0 || !(grid.heights_m[post] <= 0.0F)) continue;
            LowArea area{grid, seen};
            area.grow_from(column, row);
            if (!area.is_sea()) continue;
            for (const auto& [sea_column, sea_row] : area.posts()) sea[grid.index(sea_column, sea_row)] = 1;
        }
    }
    return sea;
}

}  // namespace eyepoint::tools
