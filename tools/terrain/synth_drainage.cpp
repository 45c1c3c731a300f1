#include "tools/terrain/synth_drainage.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <queue>
#include <utility>

namespace eyepoint::tools {

namespace {

struct Step {
    int row, column;
    double length;
};
constexpr std::array<Step, 8> kSteps{{{0, 1, 1.0},
                                      {1, 0, 1.0},
                                      {0, -1, 1.0},
                                      {-1, 0, 1.0},
                                      {1, 1, std::numbers::sqrt2},
                                      {1, -1, std::numbers::sqrt2},
                                      {-1, 1, std::numbers::sqrt2},
                                      {-1, -1, std::numbers::sqrt2}}};

bool is_border(std::size_t post, std::size_t side) {
    const std::size_t row = post / side, column = post % side;
    return row == 0 || column == 0 || row + 1 == side || column + 1 == side;
}

/// Calls visit(neighbour, length in spacings) for the neighbours of a post.
template <typename Visit>
void for_neighbours(std::uint32_t post, int side, const Visit& visit) {
    const int row = static_cast<int>(post) / side, column = static_cast<int>(post) % side;
    for (const Step& step : kSteps) {
        const int r = row + step.row, c = column + step.column;
        if (r >= 0 && c >= 0 && r < side && c < side)
            visit(static_cast<std::uint32_t>(r * side + c), step.length);
    }
}

/// Level to which each post floods before it drains, the order in which the flood reaches them, and from
/// where.
struct Flood {
    std::vector<double> level;
    std::vector<std::uint32_t> order;
    std::vector<std::uint32_t> from;
};

Flood flood(const HeightGrid& grid, const std::vector<std::uint8_t>& is_base) {
    using Front = std::pair<double, std::uint32_t>;
    const std::size_t posts = grid.heights_m.size();
    constexpr double kDry = std::numeric_limits<double>::infinity();
    Flood result{std::vector<double>(posts, kDry), {}, std::vector<std::uint32_t>(posts)};
    result.order.reserve(posts);
    std::priority_queue<Front, std::vector<Front>, std::greater<>> fronts;
    for (std::uint32_t post = 0; post < posts; ++post) {
        if (is_base[post] == 0 && !is_border(post, static_cast<std::size_t>(grid.side))) continue;
        result.level[post] = grid.heights_m[post];
        result.from[post] = post;
        fronts.emplace(result.level[post], post);
    }
    while (!fronts.empty()) {
        const auto [level, post] = fronts.top();
        fronts.pop();
        result.order.push_back(post);
        for_neighbours(post, grid.side, [&, here = post, reached = level](std::uint32_t next, double) {
            if (result.level[next] != kDry) return;
            result.level[next] = std::max(grid.heights_m[next], reached);
            result.from[next] = here;
            fronts.emplace(result.level[next], next);
        });
    }
    return result;
}

/// 0.6..1.4.
double disturbance(std::uint32_t post, std::uint32_t next, std::uint64_t seed) {
    std::uint64_t bits = (seed + ((std::uint64_t{post} << 32) | next)) * 0x9e3779b97f4a7c15ULL;
    bits = (bits ^ (bits >> 29)) * 0xbf58476d1ce4e5b9ULL;
    return 0.6 + 0.8 * static_cast<double>(bits >> 40) / static_cast<double>(1U << 24);
}

}  // namespace

Drainage route_water(const HeightGrid& grid, const std::vector<std::uint8_t>& is_base, std::uint64_t seed) {
    Flood flooded = flood(grid, is_base);
    Drainage result;
    result.receiver = flooded.from;
    for (const std::uint32_t post : flooded.order) {
        if (flooded.from[post] == post) continue;
        double steepest = 0.0;
        for_neighbours(post, grid.side, [&](std::uint32_t next, double length) {
            const double fall =
                (flooded.level[post] - flooded.level[next]) / length * disturbance(post, next, seed);
            if (fall <= steepest) return;
            steepest = fall;
            result.receiver[post] = next;
        });
    }
    result.order = std::move(flooded.order);
    result.area_m2.assign(grid.heights_m.size(), grid.spacing_m * grid.spacing_m);
    for (auto post = result.order.rbegin(); post != result.order.rend(); ++post) {
        const std::uint32_t receiver = result.receiver[*post];
        if (receiver != *post) result.area_m2[receiver] += result.area_m2[*post];
    }
    return result;
}

HeightGrid erode(const HeightGrid& grid, const std::vector<std::uint8_t>& is_base, const ErosionRates& rates,
                 std::uint64_t seed) {
    const Drainage water = route_water(grid, is_base, seed);
    HeightGrid result = grid;
    for (const std::uint32_t post : water.order) {
        const std::uint32_t receiver = water.receiver[post];
        if (receiver == post) continue;
        const bool straight =
            post / static_cast<std::uint32_t>(grid.side) ==
                receiver / static_cast<std::uint32_t>(grid.side) ||
            post % static_cast<std::uint32_t>(grid.side) == receiver % static_cast<std::uint32_t>(grid.side);
        const double run_m = grid.spacing_m * (straight ? 1.0 : std::numbers::sqrt2);
        const double cut = rates.erodibility_per_year * (*rates.erodibility_factor)[post] * rates.step_years *
                           std::sqrt(water.area_m2[post]) / run_m;
        const double raised = grid.heights_m[post] + (*rates.uplift_m_per_year)[post] * rates.step_years;
        const double below = result.heights_m[receiver];
        const double height = (raised + cut * below) / (1.0 + cut);
        result.heights_m[post] =
            std::min(std::max(height, below), below + (*rates.steepest_slope)[post] * run_m);
    }
    return result;
}

}  // namespace eyepoint::tools
