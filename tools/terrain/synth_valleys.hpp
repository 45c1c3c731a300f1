/// What ice, gravel and the sea made of the valleys that rivers cut: broad floors, lakes, a drowned coast.
#pragma once

#include <cstdint>
#include <vector>

#include "tools/terrain/synth_grid.hpp"
#include "tools/terrain/synth_setting.hpp"

namespace eyepoint::tools {

struct Valleys {
    HeightGrid ground;
    std::vector<float> water_level_msl_m;  ///< per post: of the lake at or near it, else the sea's 0
};

[[nodiscard]] Valleys shape_valleys(HeightGrid rivers, const RegionSetting& setting, std::uint64_t seed);

}  // namespace eyepoint::tools
