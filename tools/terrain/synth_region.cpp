#include "tools/terrain/synth_region.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "terrain/geodesy/earth.hpp"
#include "tools/terrain/synth_evolution.hpp"
#include "tools/terrain/synth_gullies.hpp"
#include "tools/terrain/synth_noise.hpp"

namespace eyepoint::tools {

namespace {

/// Width of the broadest gullies, against the grid's spacing: what the grid itself is too coarse for.
constexpr double kGullyPerSpacing = 4.0;

}  // namespace

std::optional<SynthRegion> SynthRegion::make(const RegionShape& shape,
                                             const std::function<bool()>& cancelled) {
    const RegionSetting setting{shape.seed};
    auto rivers = evolve(shape.half_width_m, shape.seed, setting, cancelled);
    if (!rivers || (cancelled && cancelled())) return std::nullopt;
    return SynthRegion{shape, shape_valleys(std::move(*rivers), setting, shape.seed)};
}

std::optional<RegionSample> SynthRegion::sample(double latitude_deg, double longitude_deg) const {
    const HeightGrid& grid = valleys_.ground;
    const double east_deg = std::remainder(longitude_deg - shape_.centre_longitude_deg, 360.0);
    const glm::dvec2 place{east_deg * terrain::kMetresPerDegree *
                               std::cos(shape_.centre_latitude_deg * std::numbers::pi / 180.0),
                           (latitude_deg - shape_.centre_latitude_deg) * terrain::kMetresPerDegree};
    const double outermost = std::max(std::abs(place.x), std::abs(place.y)) / shape_.half_width_m;
    if (outermost >= 1.0) return std::nullopt;
    const glm::dvec2 at = column_row(grid, place);
    const auto nearest = static_cast<std::size_t>(std::lround(at.y)) * static_cast<std::size_t>(grid.side) +
                         static_cast<std::size_t>(std::lround(at.x));
    const double gully_m =
        gullies_m(place, gradient(grid, at), kGullyPerSpacing * grid.spacing_m, shape_.seed + 800);
    return RegionSample{height_m(grid, at) + gully_m, valleys_.water_level_msl_m[nearest],
                        1.0 - smooth_step(0.72, 0.98, outermost)};
}

}  // namespace eyepoint::tools
