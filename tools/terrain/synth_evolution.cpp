#include "tools/terrain/synth_evolution.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <tbb/parallel_for.h>

#include "tools/terrain/synth_drainage.hpp"

namespace eyepoint::tools {

namespace {

/// The course of the great valleys is settled on the first grid, gullies on the last.
struct Pass {
    int side;
    int steps;
    double step_years;
};
constexpr std::array<Pass, 5> kPasses{
    {{161, 80, 2e5}, {321, 20, 1e5}, {641, 10, 7e4}, {1201, 5, 3e4}, {1701, 3, 2e4}}};

/// For areas in square metres.
constexpr double kErodibilityPerYear = 2.3e-6;

/// The grid on another number of posts, bent: each place takes its height from a place beside it, up to some
/// spacings away, as a noise a few spacings wide says. Valleys and ridges that ran along the grid then wind.
HeightGrid bent(const HeightGrid& grid, int side, const RegionSetting& setting) {
    HeightGrid result{side, grid.spacing_m * (grid.side - 1) / (side - 1), {}};
    result.heights_m.resize(static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
    const auto salt = static_cast<std::uint64_t>(side);
    tbb::parallel_for(std::size_t{0}, result.heights_m.size(), [&](std::size_t post) {
        const glm::dvec2 at = place_of(result, post);
        const double width_m = 9.0 * grid.spacing_m;
        const double bend_m = 3.0 * grid.spacing_m;
        const glm::dvec2 from = at + bend_m * glm::dvec2{setting.noise(at, width_m, salt, 3),
                                                         setting.noise(at, width_m, salt + 1, 3)};
        result.heights_m[post] = height_m(grid, column_row(grid, from));
    });
    return result;
}

struct Rock {
    std::vector<double> uplift_m_per_year, erodibility_factor, steepest_slope;
};

Rock rock_of(const HeightGrid& grid, const RegionSetting& setting) {
    const std::size_t posts = grid.heights_m.size();
    Rock rock{std::vector<double>(posts), std::vector<double>(posts), std::vector<double>(posts)};
    tbb::parallel_for(std::size_t{0}, posts, [&](std::size_t post) {
        const glm::dvec2 at = place_of(grid, post);
        rock.uplift_m_per_year[post] = setting.uplift_m_per_year(at);
        rock.erodibility_factor[post] = setting.erodibility_factor(at);
        rock.steepest_slope[post] = setting.steepest_slope(at);
    });
    return rock;
}

/// Base posts at their heights; the rest roughened, so that water on even ground finds ways of its own.
void prepare(HeightGrid& grid, const BaseLevel& base, const RegionSetting& setting) {
    tbb::parallel_for(std::size_t{0}, grid.heights_m.size(), [&](std::size_t post) {
        if (base.is_base[post] != 0) {
            grid.heights_m[post] = base.height_m[post];
        } else {
            grid.heights_m[post] +=
                0.02 * grid.spacing_m * setting.noise(place_of(grid, post), 2.0 * grid.spacing_m, 97, 2);
        }
    });
}

}  // namespace

BaseLevel base_level(const HeightGrid& grid, const RegionSetting& setting) {
    const std::size_t posts = grid.heights_m.size();
    BaseLevel base{std::vector<std::uint8_t>(posts), std::vector<double>(posts)};
    tbb::parallel_for(std::size_t{0}, posts, [&](std::size_t post) {
        const glm::dvec2 at = place_of(grid, post);
        const ValleyPlace valley = setting.in_valley(at);
        const double half_width_m = setting.floor_half_width_m(valley.along_m);
        // On a coarse grid the floor is at least a post wide, so that it is unbroken.
        const double reach_m = half_width_m > 0.0 ? std::max(half_width_m, 0.75 * grid.spacing_m) : 0.0;
        const bool sea = setting.inland_m(at) < 0.0;
        const bool floor = std::abs(valley.across_m) < reach_m;
        base.is_base[post] = sea || floor ? 1 : 0;
        if (floor && !sea) base.height_m[post] = setting.floor_msl_m(valley.along_m);
    });
    return base;
}

std::optional<HeightGrid> evolve(double half_width_m, std::uint64_t seed, const RegionSetting& setting,
                                 const std::function<bool()>& cancelled) {
    const int first = kPasses.front().side;
    HeightGrid grid{first, 2.0 * half_width_m / (first - 1),
                    std::vector<double>(static_cast<std::size_t>(first) * static_cast<std::size_t>(first))};
    const auto stop = [&cancelled] { return cancelled && cancelled(); };
    for (const Pass& pass : kPasses) {
        if (pass.side != grid.side) grid = bent(grid, pass.side, setting);
        if (stop()) return std::nullopt;
        const BaseLevel base = base_level(grid, setting);
        if (stop()) return std::nullopt;
        const Rock rock = rock_of(grid, setting);
        if (stop()) return std::nullopt;
        prepare(grid, base, setting);
        const ErosionRates rates{pass.step_years, kErodibilityPerYear, &rock.steepest_slope,
                                 &rock.uplift_m_per_year, &rock.erodibility_factor};
        for (int step = 0; step < pass.steps; ++step) {
            if (stop()) return std::nullopt;
            grid = erode(grid, base.is_base, rates, seed + static_cast<std::uint64_t>(step / 4));
        }
    }
    return grid;
}

}  // namespace eyepoint::tools
