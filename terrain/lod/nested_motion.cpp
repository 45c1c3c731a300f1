#include "terrain/lod/nested_motion.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "terrain/lod/error_level.hpp"

namespace eyepoint::terrain {

namespace {

/// log2 of a positive normal number: the exponent, and a polynomial of degree 9 through the Chebyshev nodes
/// of sqrt(1/2)..sqrt(2). The shader's, operation by operation: the libraries' differ from machine to
/// machine.
float exact_log2(float x) {
    const auto bits = std::bit_cast<std::int32_t>(x);
    std::int32_t exponent = (bits >> 23) - 127;
    auto mantissa = std::bit_cast<float>((bits & 0x7fffff) | 0x3f800000);
    if (mantissa > 1.41421354F) {
        mantissa *= 0.5F;
        exponent += 1;
    }
    const float z = mantissa - 1.0F;
    constexpr std::array<float, 9> kCoefficients{0.123109683F,  -0.205861881F, 0.216078222F,
                                                 -0.239169881F, 0.287903249F,  -0.360693276F,
                                                 0.480910748F,  -0.721347451F, 1.44269502F};
    float sum = 0.0F;
    for (const float coefficient : kCoefficients) sum = sum * z + coefficient;
    return sum * z + static_cast<float>(exponent);
}

float level_asked(const glm::vec3& from_eye, float lowest, const MotionView& view) {
    const float squared = (from_eye.x * from_eye.x + from_eye.y * from_eye.y) + from_eye.z * from_eye.z;
    const float level = std::max(exact_log2(std::max(squared * view.level_scale_squared, 1e-18F)), lowest);
    return view.morph ? level : std::floor(level);
}

DrawnVertex unpack(const BlockVertex& vertex, const SplitPosition& eye) {
    DrawnVertex result;
    for (int axis = 0; axis < 3; ++axis) {
        const auto at = static_cast<std::size_t>(axis);
        result.from_eye[axis] = (vertex.high[at] - eye.high[at]) + (vertex.low[at] - eye.low[at]);
    }
    result.place =
        glm::vec2{vertex.place & 0xffffU, vertex.place >> 16} / static_cast<float>(kVertexPlaceUnits);
    return result;
}

/// The highest floor of the edges' halves that a place in the drawn tile is on.
float floor_level(const EdgeFloors& floors, const glm::vec2& place) {
    const std::array<bool, 4> on{place.x == 0.0F, place.x == 1.0F, place.y == 0.0F, place.y == 1.0F};
    std::uint8_t highest = 0;
    for (std::size_t edge = 0; edge < on.size(); ++edge) {
        const float along = edge < 2 ? place.y : place.x;
        if (!on[edge] || along < 0.0F || along > 1.0F) continue;
        if (along <= 0.5F) highest = std::max(highest, floors[2 * edge]);
        if (along >= 0.5F) highest = std::max(highest, floors[2 * edge + 1]);
    }
    return highest;
}

/// A vertex in the block in hand, and how places there are those of the drawn tile.
struct Step {
    const TileNode* node;
    const BlockVertex* vertex;
    glm::vec2 scale{1.0F};
    glm::vec2 offset{0.0F};

    /// To the same vertex in the parent's block.
    void climb() {
        offset -= scale * glm::vec2{node->tile.x & 1U, node->tile.y & 1U};
        scale *= 2.0F;
        node = node->parent;
        vertex = &node->block->vertices[vertex->next()];
    }
    /// A vertex that stays goes later, if at all, and in an ancestor's block.
    [[nodiscard]] bool goes_above(float level) const {
        return vertex->gone_level() == NestedMesh::kStays &&
               level > static_cast<float>(node->block->last_level) && node->parent != nullptr &&
               vertex->next() != kNoVertex;
    }
};

}  // namespace

MotionView motion_view(const LodView& view, bool morph) {
    const double scale = level_scale(view.tau_px + view.slack_px, view.kappa_px);
    return {split(view.eye), static_cast<float>(scale * scale), morph};
}

DrawnVertex drawn_vertex(const TileNode& node, std::uint16_t vertex, const EdgeFloors& floors,
                         const MotionView& view) {
    Step step{&node, &node.block->vertices[vertex]};
    DrawnVertex sum;
    DrawnVertex current = unpack(*step.vertex, view.eye);
    float left = 1.0F, lowest = 0.0F;
    while (true) {
        lowest = std::max(lowest, floor_level(floors, current.place));
        const float level = level_asked(current.from_eye, lowest, view);
        while (step.goes_above(level)) step.climb();
        const std::uint8_t gone = step.vertex->gone_level();
        const float t = gone == NestedMesh::kStays
                            ? 0.0F
                            : std::clamp(level - (static_cast<float>(gone) - 1.0F), 0.0F, 1.0F);
        const float share = left * (1.0F - t);
        sum.from_eye += share * current.from_eye;
        sum.place += share * current.place;
        left *= t;
        if (left == 0.0F) return sum;
        step.vertex = &step.node->block->vertices[step.vertex->next()];
        current = unpack(*step.vertex, view.eye);
        current.place = current.place * step.scale + step.offset;
    }
}

}  // namespace eyepoint::terrain
