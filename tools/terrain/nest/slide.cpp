#include "tools/terrain/nest/slide.hpp"

#include <algorithm>

namespace eyepoint::tools {

namespace {

/// Twice the area, in samples squared, below which a triangle is a line.
constexpr double kLine = 1e-9;

double twice_area(const Corner& a, const Corner& b, const Corner& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

Corner on_the_way(const Corner& from, const Corner& to, double share) {
    Corner corner{from.x + share * (to.x - from.x), from.y + share * (to.y - from.y), {}};
    const auto part = static_cast<float>(share);
    for (std::size_t i = 0; i < 3; ++i)
        corner.position_m[i] = from.position_m[i] + part * (to.position_m[i] - from.position_m[i]);
    return corner;
}

/// The area is linear in each corner's share: over a box of shares it is least at one of the box's corners.
bool folds_between(const SlidingTriangle& triangle, double least_share, double most_share) {
    unsigned sliding = 0;
    std::array<std::array<Corner, 2>, 3> ends;
    for (std::size_t i = 0; i < 3; ++i) {
        if (triangle.moves(i)) sliding |= 1U << i;
        ends[i] = {on_the_way(triangle.from[i], triangle.to[i], least_share),
                   on_the_way(triangle.from[i], triangle.to[i], most_share)};
    }
    for (unsigned chosen = 0; chosen < 8; ++chosen) {
        if ((chosen & ~sliding) != 0) continue;
        if (twice_area(ends[0][chosen & 1U], ends[1][chosen >> 1U & 1U], ends[2][chosen >> 2U]) < -kLine)
            return true;
    }
    return false;
}

bool folds(const SlidingTriangle& triangle) {
    for (const double share : {0.0, 0.25, 0.5, 0.75}) {
        if (folds_between(triangle, std::max(share - kSharesApart, 0.0),
                          std::min(share + 0.25 + kSharesApart, 1.0)))
            return true;
    }
    return false;
}

bool within(const SampledSurface& surface, const Corner& a, const Corner& b, const Corner& c, float most_m) {
    const double area = twice_area(a, b, c);
    if (area > kLine) return surface.error_m(a, b, c, most_m) <= most_m;
    if (area < -kLine) return surface.error_m(a, c, b, most_m) <= most_m;
    return true;
}

/// What a side passes over between two shares, as two triangles.
bool crosses_well(const SampledSurface& surface, const std::array<Corner, 2>& a,
                  const std::array<Corner, 2>& b, float most_m) {
    return within(surface, a[0], a[1], b[0], most_m) && within(surface, a[1], b[0], b[1], most_m);
}

bool side_slides_well(const SlidingTriangle& triangle, std::size_t first, const SampledSurface& surface,
                      const SlideTolerance& tolerance) {
    const std::size_t second = (first + 1) % 3;
    const auto& [from, to] = triangle;
    // All at once with the least tolerance: mostly that settles it.
    if (!triangle.moves(second) && within(surface, from[first], to[first], from[second], tolerance.begin_m))
        return true;
    for (int quarter = 0; quarter < 4; ++quarter) {
        const double begin = quarter / 4.0, end = begin + 0.25;
        const auto way_of = [&](std::size_t corner) {
            return std::array<Corner, 2>{on_the_way(from[corner], to[corner], begin),
                                         on_the_way(from[corner], to[corner], end)};
        };
        if (!crosses_well(surface, way_of(first), way_of(second),
                          tolerance.between_m[static_cast<std::size_t>(quarter)]))
            return false;
    }
    return true;
}

}  // namespace

bool slides_well(const SlidingTriangle& triangle, const SampledSurface& surface,
                 const SlideTolerance& tolerance) {
    if (folds(triangle)) return false;
    if (surface.sweep_bound_m(triangle.from, triangle.to) <= tolerance.begin_m) return true;
    const auto& [from, to] = triangle;
    for (std::size_t i = 0; i < 3; ++i) {
        const double share = 0.25 * static_cast<double>(i + 1);
        if (!within(surface, on_the_way(from[0], to[0], share), on_the_way(from[1], to[1], share),
                    on_the_way(from[2], to[2], share), tolerance.quarters_m[i]))
            return false;
    }
    for (std::size_t i = 0; i < 3; ++i) {
        if (triangle.moves(i) && !side_slides_well(triangle, i, surface, tolerance)) return false;
    }
    return true;
}

}  // namespace eyepoint::tools
