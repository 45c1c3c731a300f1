#include "terrain/lod/bintree/split_vertices.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "terrain/lod/bintree/block_triangles.hpp"

namespace eyepoint::terrain::bintree {

namespace {

/// Heights at a triangle's corners.
struct Plane {
    float apex = 0.0F, left = 0.0F, right = 0.0F;
};

class Deviations {
  public:
    explicit Deviations(const BlockData& data, const BlockTriangles& triangles)
        : data_(data), triangles_(triangles) {}

    /// Greatest distance along the vertical of a post in a triangle from the triangle's plane, metres.
    /// Triangles of odd levels have their legs across the grid; their children's lie along it.
    [[nodiscard]] float of(Code code) const {
        const TriangleVertices& at = triangles_[code];
        const Plane plane{height_m(at.apex), height_m(at.left), height_m(at.right)};
        if (level(code) % 2 == 0) return from(code, plane);
        const float split = (plane.left + plane.right) * 0.5F;
        return std::max(from(left_child(code), {split, plane.apex, plane.left}),
                        from(right_child(code), {split, plane.right, plane.apex}));
    }

  private:
    [[nodiscard]] float height_m(int vertex) const {
        return data_.height_m(vertex / kBlockPosts, vertex % kBlockPosts);
    }

    /// Of a triangle of an even level: its posts are apex + i steps to the left + j steps to the right,
    /// i + j <= cells.
    [[nodiscard]] float from(Code code, const Plane& plane) const {
        const TriangleVertices& at = triangles_[code];
        const int cells = kBlockCells >> (level(code) / 2);
        const int to_left = (int{at.left} - int{at.apex}) / cells,
                  to_right = (int{at.right} - int{at.apex}) / cells;
        const float left_step = (plane.left - plane.apex) / static_cast<float>(cells),
                    right_step = (plane.right - plane.apex) / static_cast<float>(cells);
        float greatest = 0.0F;
        for (int i = 0; i <= cells; ++i) {
            const float row = plane.apex + left_step * static_cast<float>(i);
            for (int j = 0; i + j <= cells; ++j) {
                const float post = height_m(int{at.apex} + i * to_left + j * to_right);
                greatest = std::max(greatest, std::abs(post - (row + right_step * static_cast<float>(j))));
            }
        }
        return greatest;
    }

    const BlockData& data_;
    const BlockTriangles& triangles_;
};

/// Rounded up by at least what a float loses.
float distance_m(const BlockVertex& a, const BlockVertex& b) {
    glm::dvec3 apart{0.0};
    for (int axis = 0; axis < 3; ++axis) {
        const auto i = static_cast<std::size_t>(axis);
        apart[axis] = (double{a.high[i]} - double{b.high[i]}) + (double{a.low[i]} - double{b.low[i]});
    }
    constexpr double kUp = 1.0 + 2e-7;
    return static_cast<float>(glm::length(apart) * kUp);
}

void raise(LengthBound& bound, float to_m) {
    if (to_m > bound.metres()) bound = LengthBound::of(to_m);
}

}  // namespace

SplitVertices split_vertices(const Block& block) {
    const BlockTriangles& triangles = block_triangles(diagonal_of(block.data.tile));
    SplitVertices result{};
    const Deviations deviations(block.data, triangles);
    for (Code code = kSplitCodesEnd - 1; code >= kRootA; --code) {
        const TriangleVertices& at = triangles[code];
        const BlockVertex& middle = block.vertices[at.middle];
        SplitVertex& split = result[at.middle];
        raise(split.error, deviations.of(code));
        for (const std::uint16_t corner : {at.apex, at.left, at.right})
            raise(split.radius, distance_m(middle, block.vertices[corner]));
        if (level(code) + 1 == kFinestLevel) continue;
        for (const Code child : {left_child(code), right_child(code)}) {
            const std::uint16_t below = triangles[child].middle;
            raise(split.error, result[below].error.metres());
            raise(split.radius, distance_m(middle, block.vertices[below]) + result[below].radius.metres());
        }
    }
    return result;
}

}  // namespace eyepoint::terrain::bintree
