#include "tools/terrain/synth_valleys.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>

#include "tools/terrain/synth_drainage.hpp"
#include "tools/terrain/synth_evolution.hpp"
#include "tools/terrain/synth_noise.hpp"

namespace eyepoint::tools {

namespace {

/// A post that drains more than this is a river.
constexpr double kRiverAreaM2 = 1.5e6;
/// Gravel on the floor of the greatest valleys.
constexpr double kGreatestFillM = 240.0;
/// Gravel on the main valley's floor: its rivers cut to the floor itself.
constexpr double kMainFillM = 40.0;
constexpr double kLakeDepthM = 60.0;
/// How far land has sunk at the coast since its valleys were cut: they are arms of the sea, hills are
/// islands.
constexpr double kSubsidenceM = 520.0;
constexpr double kGreatestSeaHillM = 1'150.0;

/// A floor lies above its river's bed, the more the greater the river, and no floor lies below the one it
/// drains to. Slopes run out on the floor of their valley.
void broaden_valleys(HeightGrid& grid, const Drainage& water) {
    const std::vector<double> bed = grid.heights_m;
    std::vector<double> floor_m = bed;
    std::vector<std::uint32_t> river(bed.size());
    for (const std::uint32_t post : water.order) {
        const std::uint32_t receiver = water.receiver[post];
        river[post] = post;
        if (receiver == post) {
            floor_m[post] = bed[post] + std::min(kMainFillM, std::max(0.0, 0.2 * bed[post]));
        } else if (water.area_m2[post] >= kRiverAreaM2) {
            const double fill_m = kGreatestFillM * std::min(1.0, std::pow(water.area_m2[post] / 1.5e8, 0.45));
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

/// Hills of the sea's floor, off the coast: the highest are islands.
double sea_hills_m(glm::dvec2 at, double off_coast_m, const RegionSetting& setting) {
    const double near_coast =
        smooth_step(500.0, 4'000.0, off_coast_m) * (1.0 - smooth_step(9'000.0, 26'000.0, off_coast_m));
    if (near_coast <= 0.0) return 0.0;
    return kGreatestSeaHillM * near_coast * smooth_step(0.05, 0.5, setting.noise(at, 8'000.0, 89, 5));
}

/// Lowers the coast below the sea and gives the sea a floor.
void sink_coast(HeightGrid& grid, const RegionSetting& setting) {
    tbb::parallel_for(std::size_t{0}, grid.heights_m.size(), [&](std::size_t post) {
        const glm::dvec2 at = place_of(grid, post);
        const double inland_m = setting.inland_m(at);
        grid.heights_m[post] -= kSubsidenceM * (1.0 - smooth_step(0.0, 30'000.0, inland_m));
        if (inland_m < 0.0) grid.heights_m[post] += sea_hills_m(at, -inland_m, setting) + inland_m * 0.01;
    });
}

struct Lake {
    std::uint32_t outlet;
    double level_msl_m;
};

/// Lakes lie on rivers of middle size, well apart.
std::vector<Lake> choose_lakes(const HeightGrid& grid, const Drainage& water) {
    constexpr double kApartM = 11'000.0;
    constexpr std::size_t kMost = 30;
    std::vector<Lake> lakes;
    for (auto post = water.order.rbegin(); post != water.order.rend() && lakes.size() < kMost; ++post) {
        const double height_m = grid.heights_m[*post];
        const double area_m2 = water.area_m2[*post];
        if (height_m < 350.0 || height_m > 2'400.0 || area_m2 < 2e7 || area_m2 > 9e8) continue;
        const std::uint32_t receiver = water.receiver[*post];
        if (height_m - grid.heights_m[receiver] > 0.03 * grid.spacing_m) continue;
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
    constexpr double kRiseM = 55.0;
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

/// The lake in the main valley: its bed below the floor that is its surface.
void dig_main_lake(HeightGrid& grid, std::vector<float>& level_m, const RegionSetting& setting) {
    tbb::parallel_for(std::size_t{0}, grid.heights_m.size(), [&](std::size_t post) {
        const glm::dvec2 place = place_of(grid, post);
        const ValleyPlace at = setting.in_valley(place);
        const double share = setting.lake_share(at.along_m);
        const double half_width_m = 1.25 * setting.floor_half_width_m(at.along_m);
        if (share <= 0.0 || std::abs(at.across_m) > 2.0 * half_width_m) return;
        const double surface_m = setting.floor_msl_m(at.along_m) + kMainFillM - 3.0;
        level_m[post] = static_cast<float>(surface_m);
        // Narrower towards its ends, with bays.
        const double shore_m =
            half_width_m * std::sqrt(share) * (0.9 + 0.5 * setting.noise(place, 900.0, 83, 3));
        const double middle = 1.0 - smooth_step(0.6, 1.0, std::abs(at.across_m) / shore_m);
        grid.heights_m[post] -= kLakeDepthM * middle * std::min(1.0, 4.0 * share);
    });
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

Valleys shape_valleys(HeightGrid rivers, const RegionSetting& setting, std::uint64_t seed) {
    const BaseLevel base = base_level(rivers, setting);
    const Drainage water = route_water(rivers, base.is_base, seed);
    broaden_valleys(rivers, water);
    Valleys result{smoothed(rivers, 0.3), {}};
    result.water_level_msl_m = dig_lakes(result.ground, water);
    dig_main_lake(result.ground, result.water_level_msl_m, setting);
    result.water_level_msl_m = spread(result.water_level_msl_m, result.ground.side);
    sink_coast(result.ground, setting);
    return result;
}

}  // namespace eyepoint::tools
