#include "tools/terrain/synth_surface.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "terrain/geodesy/earth.hpp"
#include "tools/terrain/synth_noise.hpp"

namespace eyepoint::tools {

using namespace terrain;

namespace {

constexpr double kRadiansPerDegree = std::numbers::pi / 180.0;
/// Posts may be this share of the distance from the detailed ground apart, up to the planet's spacing.
constexpr double kSpacingPerDistance = 0.018;
constexpr double kPlanetSpacingM = 12'000.0;

GeographicExtent benchmark_extent(const SynthRequest& request) {
    const std::uint32_t depth = depth_for_spacing(request.spacing_m);
    const auto tiles = static_cast<std::uint32_t>((*request.benchmark_field_posts - 1) / kBlockCells);
    const TileId middle = tile_at(request.centre_latitude_deg, request.centre_longitude_deg, depth);
    const auto south_west = extent({depth, middle.x - tiles / 2, middle.y - tiles / 2});
    const double side = tiles * tile_side_deg(depth);
    return {south_west.west_deg, south_west.south_deg, south_west.west_deg + side,
            south_west.south_deg + side};
}

GeographicExtent detail_extent_of(const SynthRequest& request) {
    if (request.benchmark_field_posts) return benchmark_extent(request);
    const double half = request.size_deg / 2.0;
    return {request.centre_longitude_deg - half, request.centre_latitude_deg - half,
            request.centre_longitude_deg + half, request.centre_latitude_deg + half};
}

RegionShape region_of(const SynthRequest& request, const GeographicExtent& detail) {
    RegionShape shape;
    shape.centre_latitude_deg = request.centre_latitude_deg;
    shape.centre_longitude_deg = request.centre_longitude_deg;
    shape.half_width_m =
        std::max(shape.half_width_m, (detail.north_deg - detail.south_deg) / 2.0 * kMetresPerDegree * 1.35);
    shape.seed = request.seed;
    return shape;
}

/// Gap between two intervals, 0 where they meet.
double gap(double low_a, double high_a, double low_b, double high_b) {
    return std::max({0.0, low_b - high_a, low_a - high_b});
}

double distance_m(const GeographicExtent& tile, const GeographicExtent& detail) {
    const double north = gap(tile.south_deg, tile.north_deg, detail.south_deg, detail.north_deg);
    double east = 360.0;
    for (const double turn : {-360.0, 0.0, 360.0}) {
        east =
            std::min(east, gap(tile.west_deg + turn, tile.east_deg + turn, detail.west_deg, detail.east_deg));
    }
    const double nearest_pole = std::max({std::abs(tile.south_deg), std::abs(tile.north_deg)});
    return kMetresPerDegree * std::hypot(north, east * std::cos(nearest_pole * kRadiansPerDegree));
}

/// Continents, shelves and ocean floors, with mountain belts: metres above the sea. place: unit vector.
double planet_msl_m(const glm::dvec3& place, std::uint64_t seed) {
    const glm::dvec3 warp{fractal_noise(place * 2.1, seed + 100, 3, 0.5),
                          fractal_noise(place * 2.1, seed + 200, 3, 0.5),
                          fractal_noise(place * 2.1, seed + 300, 3, 0.5)};
    const glm::dvec3 bent = place + 0.35 * warp;
    const double land = fractal_noise(bent * 1.35, seed + 400, 8, 0.56) + 0.02;
    if (land < 0.0) return -4'500.0 * smooth_step(0.0, 0.22, -land) - 60.0 * std::min(1.0, -land / 0.01);
    const double belts = smooth_step(0.12, 0.5, ridged_noise(bent * 1.9, seed + 500, 3, 0.5) - 0.25) *
                         smooth_step(0.02, 0.16, land);
    const double ridges = belts > 0.0 ? ridged_noise(bent * 16.0, seed + 600, 6, 0.55) : 0.0;
    const double plain =
        900.0 * smooth_step(0.0, 0.5, land) + 120.0 * (1.0 + fractal_noise(bent * 40.0, seed + 700, 3, 0.5));
    return plain * smooth_step(0.0, 0.03, land) + 5'200.0 * belts * ridges * ridges;
}

}  // namespace

std::uint32_t depth_for_spacing(double spacing_m) {
    std::uint32_t depth = 0;
    while (depth < kMaxDepth && post_spacing_deg(depth) * kMetresPerDegree > spacing_m) ++depth;
    return depth;
}

std::optional<SynthSurface> SynthSurface::make(const SynthRequest& request, const Geoid& geoid,
                                               const std::function<bool()>& cancelled) {
    const GeographicExtent detail = detail_extent_of(request);
    auto region = SynthRegion::make(region_of(request, detail), cancelled);
    if (!region) return std::nullopt;
    return SynthSurface{request, geoid, detail, std::move(*region)};
}

SynthSurface::SynthSurface(const SynthRequest& request, const Geoid& geoid, const GeographicExtent& detail,
                           SynthRegion region)
    : geoid_(geoid),
      seed_(request.seed),
      spacing_m_(request.spacing_m),
      detail_(detail),
      region_(std::move(region)) {}

bool SynthSurface::has_detail(TileId tile) const {
    // A tile that only touches the detailed ground holds none of it.
    const auto sides = extent(tile);
    const double inset = tile_side_deg(tile.depth) * 1e-6;
    const double away_m = distance_m(
        {sides.west_deg + inset, sides.south_deg + inset, sides.east_deg - inset, sides.north_deg - inset},
        detail_);
    const double wanted_m =
        std::clamp(away_m * kSpacingPerDistance, spacing_m_, std::max(spacing_m_, kPlanetSpacingM));
    return tile.depth <= depth_for_spacing(wanted_m);
}

SynthSurface::Place SynthSurface::at(double latitude_deg, double longitude_deg) const {
    const double latitude = latitude_deg * kRadiansPerDegree, longitude = longitude_deg * kRadiansPerDegree;
    const glm::dvec3 place{std::cos(latitude) * std::cos(longitude), std::cos(latitude) * std::sin(longitude),
                           std::sin(latitude)};
    const auto region = region_.sample(latitude_deg, longitude_deg);
    double ground_m = 0.0, level_m = 0.0;
    if (region && region->weight > 0.0) {
        level_m = region->weight == 1.0 ? region->water_level_msl_m : 0.0;
        ground_m = region->ground_msl_m;
    }
    if (!region || region->weight < 1.0) {
        const double weight = region ? region->weight : 0.0;
        ground_m = weight * ground_m + (1.0 - weight) * planet_msl_m(place, seed_);
    }
    return ground_m < level_m ? Place{level_m, true} : Place{ground_m, false};
}

void SynthSurface::sample(const Lattice& lattice, std::span<SurfaceSample> out) const {
    std::size_t post = 0;
    for (int row = 0; row < lattice.rows; ++row) {
        double latitude_deg = lattice.south_deg + row * lattice.step_deg;
        const bool over_pole = std::abs(latitude_deg) > 90.0;
        if (over_pole) latitude_deg = std::copysign(180.0, latitude_deg) - latitude_deg;
        for (int column = 0; column < lattice.columns; ++column) {
            const double longitude_deg =
                lattice.west_deg + column * lattice.step_deg + (over_pole ? 180.0 : 0.0);
            const Place place = at(latitude_deg, longitude_deg);
            out[post++] = {static_cast<float>(place.msl_m + geoid_.undulation_m(latitude_deg, longitude_deg)),
                           place.water};
        }
    }
}

}  // namespace eyepoint::tools
