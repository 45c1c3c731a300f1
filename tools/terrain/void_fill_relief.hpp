/// Fractal relief for the inside of voids.
#pragma once

namespace eyepoint::tools {

/// Ridged gradient noise of wavelengths 64 to 4 posts whose root mean square second difference over 2 posts
/// is about 1. A pure function of place, in posts.
[[nodiscard]] float ridged_relief(double column, double row);

}  // namespace eyepoint::tools
