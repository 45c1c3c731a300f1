#include "tools/terrain/synth_region.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <tbb/parallel_for.h>

#include "terrain/geodesy/earth.hpp"
#include "tools/terrain/synth_noise.hpp"

namespace eyepoint::tools {

namespace {

/// Erosion runs on finer and finer grids: the course of the great valleys is settled on the first.
struct Pass {
    int side;
    int steps;
    double step_years;
};
constexpr std::array<Pass, 4> kPasses{{{161, 120, 2e5}, {321, 20, 1e5}, {641, 10, 7e4}, {1281, 4, 3e4}}};

constexpr double kUpliftMPerYear = 1e-3;
constexpr double kErodibilityPerYear = 5.5e-6;
constexpr double kSteepestSlope = 1.2;
constexpr double kHighestM = 3'500.0;
/// Then the whole range, but not the coast, is lifted by this.
constexpr double kLiftM = 750.0;
/// A post that drains more than this is a river.
constexpr double kRiverAreaM2 = 3e6;

/// The main valley's line, in the region's metres east and north of its centre: under the sample flight.
constexpr glm::dvec2 kValleyPoint{-6'100.0, -3'800.0};
constexpr double kValleyAzimuthDeg = 61.0;
constexpr double kValleyHalfWidthM = 1'700.0;
/// The coast lies this far from the centre, towards the south-west.
constexpr double kCoastM = 58'000.0;
constexpr double kCoastAzimuthDeg = 230.0;
/// How far land has sunk at the coast since its valleys were cut: they are arms of the sea, hills are
/// islands.
constexpr double kSubsidenceM = 480.0;

glm::dvec2 direction(double azimuth_deg) {
    const double azimuth = azimuth_deg * std::numbers::pi / 180.0;
    return {std::sin(azimuth), std::cos(azimuth)};
}

/// The fields that shape the region, all functions of metres east and north of its centre.
class Setting {
  public:
    explicit Setting(std::uint64_t seed) : seed_(seed) {}

    /// Metres from the ancient coast, land positive.
    [[nodiscard]] double inland_m(glm::dvec2 at) const {
        return kCoastM - glm::dot(at, direction(kCoastAzimuthDeg)) + 48'000.0 * noise(at, 36'000.0, 11, 5);
    }

    [[nodiscard]] double uplift_m_per_year(glm::dvec2 at) const {
        const double massif = 0.1 + 0.9 * smooth_step(0.0, 55'000.0, inland_m(at));
        const double blocks = 0.9 + 0.8 * noise(at, 26'000.0, 29, 3);
        return kUpliftMPerYear * massif * std::clamp(blocks, 0.25, 1.6) * (1.0 - 0.5 * in_valley(at));
    }

    /// Rock differs: weak along the main valley's fault, and in bands.
    [[nodiscard]] double erodibility_factor(glm::dvec2 at) const {
        return std::exp(1.1 * noise(at, 9'000.0, 53, 4)) * (1.0 + 0.6 * in_valley(at));
    }

    [[nodiscard]] double noise(glm::dvec2 at, double width_m, std::uint64_t salt, int octaves) const {
        return fractal_noise({at.x / width_m, at.y / width_m, 0.5 + static_cast<double>(salt)},
                             seed_ + salt * 1000, octaves, 0.5);
    }

  private:
    /// 1 on the main valley's line, to 0 beside it. The line bends, but hardly under the flight.
    [[nodiscard]] double in_valley(glm::dvec2 at) const {
        const glm::dvec2 along = direction(kValleyAzimuthDeg);
        const glm::dvec2 from = at - kValleyPoint;
        const double down_valley = glm::dot(from, along);
        const double bend = 9'000.0 * noise({down_valley, 0.0}, 38'000.0, 71, 2) *
                            smooth_step(8'000.0, 30'000.0, std::abs(down_valley));
        const double across = from.x * along.y - from.y * along.x + bend;
        return std::exp(-across * across / (2.0 * kValleyHalfWidthM * kValleyHalfWidthM));
    }

    std::uint64_t seed_;
};

glm::dvec2 place_of(const HeightGrid& grid, std::size_t post) {
    const auto side = static_cast<std::size_t>(grid.side);
    const double half = grid.spacing_m * (grid.side - 1) / 2.0;
    return {static_cast<double>(post % side) * grid.spacing_m - half,
            static_cast<double>(post / side) * grid.spacing_m - half};
}

template <typename Value>
double bilinear(const HeightGrid& grid, const std::vector<Value>& values, double column, double row) {
    const int c = std::clamp(static_cast<int>(column), 0, grid.side - 2);
    const int r = std::clamp(static_cast<int>(row), 0, grid.side - 2);
    const double u = column - c, v = row - r;
    const auto at = [&](int dr, int dc) {
        return static_cast<double>(values[static_cast<std::size_t>((r + dr) * grid.side + c + dc)]);
    };
    return (at(0, 0) * (1.0 - u) + at(0, 1) * u) * (1.0 - v) + (at(1, 0) * (1.0 - u) + at(1, 1) * u) * v;
}

std::vector<std::uint8_t> sea_of(const HeightGrid& grid, const Setting& setting) {
    std::vector<std::uint8_t> sea(grid.heights_m.size());
    for (std::size_t post = 0; post < sea.size(); ++post)
        sea[post] = setting.inland_m(place_of(grid, post)) < 0.0;
    return sea;
}

/// Creep: ground evens out a little, so that slopes are not the straight lines of the grid's eight
/// directions.
void smooth(HeightGrid& grid, int times) {
    const int side = grid.side;
    for (int pass = 0; pass < times; ++pass) {
        const std::vector<double> before = grid.heights_m;
        for (int row = 1; row + 1 < side; ++row) {
            for (int column = 1; column + 1 < side; ++column) {
                const auto at = static_cast<std::size_t>(row * side + column);
                const auto up = static_cast<std::size_t>(side);
                const double straight = before[at - 1] + before[at + 1] + before[at - up] + before[at + up];
                const double oblique =
                    before[at - up - 1] + before[at - up + 1] + before[at + up - 1] + before[at + up + 1];
                grid.heights_m[at] = 0.5 * before[at] + straight / 12.0 + oblique / 24.0;
            }
        }
    }
}

/// Catmull-Rom weights of four posts for a place a share t of the way from the second to the third.
std::array<double, 4> cubic_weights(double t) {
    return {((-0.5 * t + 1.0) * t - 0.5) * t, (1.5 * t - 2.5) * t * t + 1.0, ((-1.5 * t + 2.0) * t + 0.5) * t,
            (0.5 * t - 0.5) * t * t};
}

double bicubic(const HeightGrid& grid, double column, double row) {
    const int c = std::clamp(static_cast<int>(column), 1, grid.side - 3);
    const int r = std::clamp(static_cast<int>(row), 1, grid.side - 3);
    const auto across = cubic_weights(column - c);
    const auto up = cubic_weights(row - r);
    double sum = 0.0;
    for (int j = 0; j < 4; ++j) {
        const double* post = &grid.heights_m[static_cast<std::size_t>((r + j - 1) * grid.side + c - 1)];
        sum += up[static_cast<std::size_t>(j)] *
               (across[0] * post[0] + across[1] * post[1] + across[2] * post[2] + across[3] * post[3]);
    }
    return sum;
}

/// The grid on another number of posts, bent: each place takes its height from a place beside it, up to some
/// spacings away, as a noise a few spacings wide says. Valleys and ridges that ran along the grid then wind.
HeightGrid bent(const HeightGrid& grid, int side, const Setting& setting, std::uint64_t salt) {
    HeightGrid result{side, grid.spacing_m * (grid.side - 1) / (side - 1), {}};
    result.heights_m.resize(static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
    const double half = grid.spacing_m * (grid.side - 1) / 2.0;
    tbb::parallel_for(std::size_t{0}, result.heights_m.size(), [&](std::size_t post) {
        const glm::dvec2 at = place_of(result, post);
        const double width_m = 9.0 * grid.spacing_m;
        const double bend_m = 3.2 * grid.spacing_m;
        const glm::dvec2 from{at.x + bend_m * setting.noise(at, width_m, salt, 3),
                              at.y + bend_m * setting.noise(at, width_m, salt + 1, 3)};
        const auto index = [&](double metres) {
            return std::clamp((metres + half) / grid.spacing_m, 0.0, grid.side - 1.0);
        };
        result.heights_m[post] = bicubic(grid, index(from.x), index(from.y));
    });
    return result;
}

HeightGrid evolve(const RegionShape& shape, const Setting& setting) {
    const int first = kPasses.front().side;
    HeightGrid grid{first, 2.0 * shape.half_width_m / (first - 1),
                    std::vector<double>(static_cast<std::size_t>(first) * static_cast<std::size_t>(first))};
    for (const Pass& pass : kPasses) {
        if (pass.side != grid.side)
            grid = bent(grid, pass.side, setting, static_cast<std::uint64_t>(pass.side));
        const auto sea = sea_of(grid, setting);
        std::vector<double> uplift(sea.size()), factor(sea.size());
        tbb::parallel_for(std::size_t{0}, sea.size(), [&](std::size_t post) {
            const glm::dvec2 at = place_of(grid, post);
            uplift[post] = setting.uplift_m_per_year(at);
            factor[post] = setting.erodibility_factor(at);
            // Roughness, so that water on even ground finds ways of its own.
            const double rough_m = 3.0 * setting.noise(at, 2.0 * grid.spacing_m, 97, 2);
            grid.heights_m[post] = sea[post] == 0 ? grid.heights_m[post] + rough_m : 0.0;
        });
        for (int step = 0; step < pass.steps; ++step) {
            grid = erode(grid, sea, {pass.step_years, kErodibilityPerYear, kSteepestSlope, &uplift, &factor},
                         shape.seed + static_cast<std::uint64_t>(step / 4));
        }
        smooth(grid, 1);
    }
    return bent(grid, grid.side, setting, 7);
}

/// Scales the range so that its highest summits are as high as they should be.
void scale_heights(HeightGrid& grid) {
    std::vector<double> sorted = grid.heights_m;
    const auto high =
        sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() - sorted.size() / 20'000 - 1);
    std::ranges::nth_element(sorted, high);
    for (double& height_m : grid.heights_m) height_m *= kHighestM / *high;
}

/// Raises the range, which makes its rivers steep on their last way to the sea.
void lift(HeightGrid& grid) {
    for (std::size_t post = 0; post < grid.heights_m.size(); ++post) {
        const double from_coast_m = kCoastM - glm::dot(place_of(grid, post), direction(kCoastAzimuthDeg));
        if (grid.heights_m[post] > 0.0)
            grid.heights_m[post] += kLiftM * smooth_step(12'000.0, 54'000.0, from_coast_m);
    }
}

/// Ice and gravel have made the floors of the valleys broad: a floor lies above its river's bed, the more the
/// greater the river, and no floor lies below the one it drains to. Slopes run out on the floor of their
/// valley.
void broaden_valleys(HeightGrid& grid, const Drainage& water) {
    const std::vector<double> bed = grid.heights_m;
    std::vector<double> floor_m = bed;
    std::vector<std::uint32_t> river(bed.size());
    for (const std::uint32_t post : water.order) {
        const std::uint32_t receiver = water.receiver[post];
        river[post] = post;
        if (receiver == post) continue;
        if (water.area_m2[post] >= kRiverAreaM2) {
            const double fill_m = 80.0 * std::min(1.0, std::pow(water.area_m2[post] / 4e8, 0.45));
            floor_m[post] = std::max(bed[post] + fill_m, floor_m[receiver]);
        } else {
            river[post] = river[receiver];
        }
        const double above_m = std::max(0.0, bed[post] - bed[river[post]]);
        const double fill_m = floor_m[river[post]] - bed[river[post]];
        grid.heights_m[post] =
            bed[river[post]] + std::cbrt(above_m * above_m * above_m + fill_m * fill_m * fill_m);
    }
}

/// Lowers the coast below the sea and gives the sea a floor.
void sink_coast(HeightGrid& grid, const Setting& setting) {
    tbb::parallel_for(std::size_t{0}, grid.heights_m.size(), [&](std::size_t post) {
        const double inland_m = setting.inland_m(place_of(grid, post));
        grid.heights_m[post] -= kSubsidenceM * (1.0 - smooth_step(0.0, 34'000.0, inland_m));
        if (inland_m < 0.0) grid.heights_m[post] += inland_m * 0.02;
    });
}

struct Lake {
    std::uint32_t outlet;
    double level_msl_m;
};

/// Lakes lie on rivers of middle size, well apart.
std::vector<Lake> choose_lakes(const HeightGrid& grid, const Drainage& water) {
    constexpr double kApartM = 13'000.0;
    constexpr std::size_t kMost = 26;
    std::vector<Lake> lakes;
    for (auto post = water.order.rbegin(); post != water.order.rend() && lakes.size() < kMost; ++post) {
        const double height_m = grid.heights_m[*post];
        const double area_m2 = water.area_m2[*post];
        if (height_m < 350.0 || height_m > 2'300.0 || area_m2 < 4e7 || area_m2 > 9e8) continue;
        const std::uint32_t receiver = water.receiver[*post];
        if (height_m - grid.heights_m[receiver] > 0.028 * grid.spacing_m) continue;
        const bool apart = std::ranges::all_of(lakes, [&](const Lake& lake) {
            return glm::distance(place_of(grid, lake.outlet), place_of(grid, *post)) > kApartM;
        });
        if (apart) lakes.push_back({*post, height_m});
    }
    return lakes;
}

/// Deepens the valley above each lake's outlet so that its floor is below the outlet's level. Above the shore
/// the slopes meet the old ones again.
std::vector<float> dig_lakes(HeightGrid& grid, const Drainage& water) {
    constexpr double kRiseM = 65.0;
    std::vector<float> level_m(grid.heights_m.size(), 0.0F);
    std::vector<std::int32_t> lake_of(grid.heights_m.size(), -1);
    const auto lakes = choose_lakes(grid, water);
    for (std::size_t i = 0; i < lakes.size(); ++i) lake_of[lakes[i].outlet] = static_cast<std::int32_t>(i);
    for (const std::uint32_t post : water.order) {
        if (lake_of[post] < 0) lake_of[post] = lake_of[water.receiver[post]];
        if (lake_of[post] < 0) continue;
        const double level = lakes[static_cast<std::size_t>(lake_of[post])].level_msl_m;
        const double above_m = grid.heights_m[post] - level;
        if (above_m > 6.0 * kRiseM || water.receiver[post] == post) continue;
        level_m[post] = static_cast<float>(level);
        if (post != lakes[static_cast<std::size_t>(lake_of[post])].outlet) {
            grid.heights_m[post] = level + (above_m - kRiseM) * 6.0 / 5.0;
        }
    }
    return level_m;
}

/// Water levels reach a few posts beyond the water, so that every place near a shore knows them.
std::vector<float> spread(const std::vector<float>& level_m, int side) {
    std::vector<float> result = level_m;
    for (int row = 1; row + 1 < side; ++row) {
        for (int column = 1; column + 1 < side; ++column) {
            const auto at = static_cast<std::size_t>(row * side + column);
            for (int i = 0; i < 9 && result[at] == 0.0F; ++i) {
                result[at] = level_m[static_cast<std::size_t>((row + i / 3 - 1) * side + column + i % 3 - 1)];
            }
        }
    }
    return result;
}

}  // namespace

SynthRegion::SynthRegion(const RegionShape& shape) : shape_(shape) {
    const Setting setting{shape.seed};
    grid_ = evolve(shape, setting);
    scale_heights(grid_);
    lift(grid_);
    const Drainage water = route_water(grid_, sea_of(grid_, setting), shape.seed);
    broaden_valleys(grid_, water);
    smooth(grid_, 1);
    water_level_msl_m_ = spread(dig_lakes(grid_, water), grid_.side);
    sink_coast(grid_, setting);
}

std::optional<RegionSample> SynthRegion::sample(double latitude_deg, double longitude_deg) const {
    constexpr double kMetresPerDegree = terrain::kEquatorialRadiusM * std::numbers::pi / 180.0;
    const double east_deg = std::remainder(longitude_deg - shape_.centre_longitude_deg, 360.0);
    const double x =
        east_deg * kMetresPerDegree * std::cos(shape_.centre_latitude_deg * std::numbers::pi / 180.0);
    const double y = (latitude_deg - shape_.centre_latitude_deg) * kMetresPerDegree;
    const double outermost = std::max(std::abs(x), std::abs(y)) / shape_.half_width_m;
    if (outermost >= 1.0) return std::nullopt;
    const double column = (x + shape_.half_width_m) / grid_.spacing_m;
    const double row = (y + shape_.half_width_m) / grid_.spacing_m;
    const auto nearest = static_cast<std::size_t>(std::lround(row)) * static_cast<std::size_t>(grid_.side) +
                         static_cast<std::size_t>(std::lround(column));
    const double east_fall = bilinear(grid_, grid_.heights_m, column + 1.0, row) -
                             bilinear(grid_, grid_.heights_m, column - 1.0, row);
    const double north_fall = bilinear(grid_, grid_.heights_m, column, row + 1.0) -
                              bilinear(grid_, grid_.heights_m, column, row - 1.0);
    return RegionSample{bicubic(grid_, column, row), water_level_msl_m_[nearest],
                        std::hypot(east_fall, north_fall) / (2.0 * grid_.spacing_m),
                        1.0 - smooth_step(0.72, 0.98, outermost)};
}

}  // namespace eyepoint::tools
