#include "tools/terrain/synth_setting.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include "tools/terrain/synth_noise.hpp"

namespace eyepoint::tools {

namespace {

constexpr double kUpliftMPerYear = 1e-3;

/// The main valley's line: under the sample flight, along its course.
constexpr glm::dvec2 kValleyPoint{-6'100.0, -3'800.0};
constexpr double kValleyAzimuthDeg = 61.0;
/// Its ends, down and up the valley from there.
constexpr double kValleyMouthM = -66'000.0;
constexpr double kValleyHeadM = 34'000.0;
constexpr double kFloorMslM = 1'290.0;
constexpr double kLakeFromM = 7'500.0;
constexpr double kLakeToM = 14'500.0;

/// The coast lies this far from the centre, towards the south-west.
constexpr double kCoastM = 58'000.0;
constexpr double kCoastAzimuthDeg = 230.0;

glm::dvec2 direction(double azimuth_deg) {
    const double azimuth = azimuth_deg * std::numbers::pi / 180.0;
    return {std::sin(azimuth), std::cos(azimuth)};
}

/// The highest summits stand in two rows beside the main valley: 1 there, to 0.
double in_rows(const ValleyPlace& at) {
    const double from_row = (std::abs(at.across_m) - 9'500.0) / 4'500.0;
    return std::exp(-from_row * from_row);
}

}  // namespace

double RegionSetting::noise(glm::dvec2 at, double width_m, std::uint64_t salt, int octaves) const {
    return fractal_noise({at.x / width_m, at.y / width_m, 0.5 + static_cast<double>(salt)},
                         seed_ + salt * 1000, octaves, 0.5);
}

double RegionSetting::inland_m(glm::dvec2 at) const {
    return kCoastM - glm::dot(at, direction(kCoastAzimuthDeg)) + 48'000.0 * noise(at, 36'000.0, 11, 5);
}

double RegionSetting::uplift_m_per_year(glm::dvec2 at) const {
    const double massif = 0.3 + 0.7 * smooth_step(0.0, 45'000.0, inland_m(at));
    const double blocks = 1.0 + 0.9 * noise(at, 24'000.0, 29, 3);
    return kUpliftMPerYear * massif * std::clamp(blocks, 0.4, 1.6) * (1.0 + 0.65 * in_rows(in_valley(at)));
}

double RegionSetting::erodibility_factor(glm::dvec2 at) const {
    return std::exp(0.9 * noise(at, 9'000.0, 53, 4));
}

double RegionSetting::steepest_slope(glm::dvec2 at) const {
    return 0.53 + 0.19 * in_rows(in_valley(at)) + 0.6 * noise(at, 5'000.0, 59, 3);
}

ValleyPlace RegionSetting::in_valley(glm::dvec2 at) const {
    const glm::dvec2 up_valley = direction(kValleyAzimuthDeg);
    const glm::dvec2 from = at - kValleyPoint;
    const double along_m = glm::dot(from, up_valley);
    // The line winds, but hardly under the flight.
    const double free = smooth_step(5'000.0, 24'000.0, std::abs(along_m));
    const double bend_m = free * 9'000.0 * noise({along_m, 0.0}, 30'000.0, 71, 2) +
                          1'500.0 * noise({along_m, 0.0}, 8'000.0, 73, 3);
    return {along_m, from.x * up_valley.y - from.y * up_valley.x + bend_m};
}

double RegionSetting::floor_half_width_m(double along_m) const {
    const double ends = smooth_step(kValleyMouthM, kValleyMouthM + 2'000.0, along_m) *
                        smooth_step(-kValleyHeadM, 9'000.0 - kValleyHeadM, -along_m);
    return ends * (std::clamp(640.0 + 900.0 * noise({along_m, 0.0}, 4'200.0, 79, 2), 420.0, 950.0) +
                   120.0 * lake_share(along_m));
}

double RegionSetting::lake_share(double along_m) const {
    return smooth_step(kLakeFromM, kLakeFromM + 1'200.0, along_m) *
           smooth_step(-kLakeToM, 2'500.0 - kLakeToM, -along_m);
}

double RegionSetting::floor_msl_m(double along_m) const {
    if (along_m < 0.0) return kFloorMslM * std::pow(std::max(0.0, 1.0 - along_m / kValleyMouthM), 1.2);
    // Level under the lake.
    const double dry_m = std::min(along_m, kLakeFromM) + std::max(0.0, along_m - kLakeToM);
    return kFloorMslM + 0.011 * dry_m + 2.5e-7 * dry_m * dry_m;
}

}  // namespace eyepoint::tools
