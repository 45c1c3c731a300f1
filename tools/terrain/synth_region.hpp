/// The synthetic mountain region: a range with a main valley from north-east to south-west, side valleys,
/// lakes, and a drowned coast with islands in the south-west. Shaped on a grid by erosion
/// (synth_evolution.hpp, synth_valleys.hpp), once, from a seed, and given gullies where it is read.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <utility>

#include "tools/terrain/synth_valleys.hpp"

namespace eyepoint::tools {

struct RegionShape {
    double centre_latitude_deg = 46.45;
    double centre_longitude_deg = 8.25;
    double half_width_m = 110'000.0;  ///< of the square grid
    std::uint64_t seed = 1;
};

/// The region's ground at a place.
struct RegionSample {
    double ground_msl_m = 0.0;       ///< the bed, where there is water
    double water_level_msl_m = 0.0;  ///< of the nearest lake, or the sea's 0
    double weight = 0.0;             ///< 1 inside, to 0 at the border of the grid
};

/// Thread use: const use is safe from any thread.
class SynthRegion {
  public:
    /// Takes some ten seconds. cancelled is asked about every second, and may be empty; nothing is made once
    /// it says so.
    [[nodiscard]] static std::optional<SynthRegion> make(const RegionShape& shape,
                                                         const std::function<bool()>& cancelled);

    /// Nothing beyond the grid.
    [[nodiscard]] std::optional<RegionSample> sample(double latitude_deg, double longitude_deg) const;

  private:
    SynthRegion(const RegionShape& shape, Valleys valleys) : shape_(shape), valleys_(std::move(valleys)) {}

    RegionShape shape_;
    Valleys valleys_;
};

}  // namespace eyepoint::tools
