/// The synthetic mountain region: a range with a main valley from north-east to south-west, side valleys,
/// lakes, and a drowned coast with islands in the south-west. Shaped on a grid by erosion
/// (synth_drainage.hpp), once, from a seed.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "tools/terrain/synth_drainage.hpp"

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
    double slope = 0.0;              ///< of the grid: rise over run
    double weight = 0.0;             ///< 1 inside, to 0 at the border of the grid
};

/// Thread use: const use is safe from any thread.
class SynthRegion {
  public:
    explicit SynthRegion(const RegionShape& shape);

    /// Nothing beyond the grid.
    [[nodiscard]] std::optional<RegionSample> sample(double latitude_deg, double longitude_deg) const;
    [[nodiscard]] double grid_spacing_m() const { return grid_.spacing_m; }

  private:
    RegionShape shape_;
    HeightGrid grid_;
    std::vector<float> water_level_msl_m_;
};

}  // namespace eyepoint::tools
