/// The drawn surface of a selection of nested meshes, triangle by triangle as the shader moves them, and its
/// gaps.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "terrain/lod/nested_motion.hpp"

namespace eyepoint::testing {

/// A position by its bits.
using PointBits = std::array<std::uint32_t, 3>;
[[nodiscard]] PointBits bits_of(const terrain::DrawnVertex& vertex);

struct DrawnTriangle {
    std::array<PointBits, 3> corners{};  ///< counterclockwise, the smallest first
    auto operator<=>(const DrawnTriangle&) const = default;
};

/// Every triangle whose corners are three different points, sorted.
[[nodiscard]] std::vector<DrawnTriangle> drawn_triangles(std::span<const terrain::BlockDraw> draws,
                                                         const terrain::MotionView& view);

/// An inner edge of the drawn surface must have as many triangles on its left as on its right, with bit-equal
/// end points: one, where the surface is not folded. An edge is inner unless it lies on the edge of a drawn
/// tile beyond which something is not drawn.
struct NestedFaults {
    std::size_t edges = 0;   ///< looked at
    std::size_t cracks = 0;  ///< not as many on one side as on the other
    std::size_t overlaps =
        0;  ///< more than one on a side: folded, or distinct points that float cannot tell apart
};
[[nodiscard]] NestedFaults find_nested_faults(std::span<const terrain::BlockDraw> draws,
                                              const terrain::MotionView& view);

/// Draws of which one tile is above another: the same place drawn twice.
[[nodiscard]] std::size_t count_stacked(std::span<const terrain::BlockDraw> draws);

}  // namespace eyepoint::testing
