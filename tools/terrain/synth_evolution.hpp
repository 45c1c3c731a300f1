/// The region's mountains before ice and lakes: rivers against uplift, on finer and finer grids.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "tools/terrain/synth_grid.hpp"
#include "tools/terrain/synth_setting.hpp"

namespace eyepoint::tools {

/// Where rivers end: the sea, at height 0, and the floor of the main valley, at its own.
struct BaseLevel {
    std::vector<std::uint8_t> is_base;
    std::vector<double> height_m;  ///< of base posts
};
[[nodiscard]] BaseLevel base_level(const HeightGrid& grid, const RegionSetting& setting);

/// Nothing when cancelled, which is asked every second or so and may be empty.
[[nodiscard]] std::optional<HeightGrid> evolve(double half_width_m, std::uint64_t seed,
                                               const RegionSetting& setting,
                                               const std::function<bool()>& cancelled);

}  // namespace eyepoint::tools
