/// Filling voids: posts for which a file has no height though it has some around them.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "tools/terrain/mosaic_grid.hpp"

namespace eyepoint::tools {

/// A void that reaches further than this from its rim is no void but an area outside of what the file covers:
/// 64 posts (6 km in SRTM) or a tenth of a degree, whichever is less, but at least 3 posts; three times as
/// much where heights enclose it, for then the file means to cover it.
[[nodiscard]] float deepest_void_posts(double spacing_deg, bool enclosed);

/// Heights of a coarser surface, MSL metres, at posts of a grid.
using CoarserSurface = std::function<std::vector<float>(std::span<const GridPosition>)>;

struct VoidFill {
    std::uint64_t filled = 0;
    std::uint64_t outside = 0;  ///< left void: further from any height than deepest_void_posts()
};

/// Fills voids in place of kVoid, by delta surface fill: the difference between the grid and a reference
/// shape is interpolated over the void from its rim by a thin plate under slight tension, which continues the
/// slopes of the rim, and added to the shape. The shape is the coarser surface (which may be empty) plus
/// ridged fractal relief that is as rough as the ground around the void: conditional simulation (Journel,
/// Geostatistics for Conditional Simulation of Ore Bodies, 1974), so the relief vanishes at the rim and grows
/// inwards. The same grid gives the same fill. Delta surface fill: Grohman, Kroenung and Strebeck, Filling
/// SRTM Voids: The Delta Surface Fill Method, PE&RS 2006.
[[nodiscard]] VoidFill fill_voids(HeightGrid& grid, const CoarserSurface& coarser);

}  // namespace eyepoint::tools
