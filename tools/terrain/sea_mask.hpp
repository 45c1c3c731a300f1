/// Which posts of a grid are the sea's surface.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "tools/terrain/mosaic_grid.hpp"

namespace eyepoint::tools {

enum class SeaRule : std::uint8_t {
    Auto,   ///< by the shape of each connected area at or below 0, see find_sea()
    None,   ///< heights are taken as they are, nothing is water
    Clamp,  ///< every post at or below 0 is sea
};
[[nodiscard]] std::optional<SeaRule> sea_rule_named(std::string_view name);

/// No dry land on Earth lies lower (the shore of the Dead Sea, about -430 m): what does, is under water.
inline constexpr float kLowestDryLandM = -500.0F;
/// Smaller areas of zeros inside a grid are noise on low land, not sea.
inline constexpr std::size_t kSmallestSeaPosts = 16;

/// 1 for every post of MSL height grid that is sea. Auto: a 4-connected area of posts at or below 0 m is sea
/// if more than half of it is exactly 0 (how SRTM flattens the sea, with small negatives at the coast), or if
/// it reaches below kLowestDryLandM (bathymetry). Anything else at or below 0 is dry land: polders, Death
/// Valley, Danakil.
[[nodiscard]] std::vector<std::uint8_t> find_sea(const HeightGrid& grid, SeaRule rule);

}  // namespace eyepoint::tools
