/// Triangles whose corners slide to other places from one level to the next (terrain/lod/nested_motion.hpp).
#pragma once

#include <array>

#include "tools/terrain/nest/sampled_surface.hpp"

namespace eyepoint::tools {

/// Corners counterclockwise; one that stays has the same place twice.
struct SlidingTriangle {
    std::array<Corner, 3> from;  ///< at the level before
    std::array<Corner, 3> to;
    /// From here to its next corner, a side that moves is looked at too. The other way it is its neighbour's.
    [[nodiscard]] bool moves(std::size_t corner) const {
        return from[corner].x != to[corner].x || from[corner].y != to[corner].y;
    }
};

/// How far apart corners' shares of their slides may be, by their distances from the eye, for a triangle not
/// to fold.
inline constexpr double kSharesApart = 0.1;

/// What errors are allowed when a slide begins, in its quarters, and half-way through its quarters; metres.
/// Not less on the way than at its beginning.
struct SlideTolerance {
    float begin_m = 0.0F;
    std::array<float, 3> quarters_m{};
    std::array<float, 4> between_m{};
};

/// Whether on its way a triangle does not fold, for any shares of its corners' slides at most kSharesApart
/// apart, and has no greater error than the tolerance: at the quarters, and wherever a side crosses a sample
/// (exactly where one end of the side slides: on the plane through its two ends and the place that the end
/// slides to). Between crossings the error of a sample is a ratio of linear functions of the share, so it has
/// no other extremes.
[[nodiscard]] bool slides_well(const SlidingTriangle& triangle, const SampledSurface& surface,
                               const SlideTolerance& tolerance);

}  // namespace eyepoint::tools
