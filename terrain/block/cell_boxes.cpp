#include "terrain/block/cell_boxes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "terrain/block/block.hpp"

namespace eyepoint::terrain {

namespace {

static_assert(CellBoxes::kCells == std::size_t{kMeshCells} * kMeshCells);

Ecef position(const BlockVertex& vertex) {
    return glm::dvec3{vertex.high[0], vertex.high[1], vertex.high[2]} +
           glm::dvec3{vertex.low[0], vertex.low[1], vertex.low[2]};
}

struct LevelBox {
    glm::vec3 low{std::numeric_limits<float>::max()};
    glm::vec3 high{std::numeric_limits<float>::lowest()};

    void add(const glm::vec3& point) {
        low = glm::min(low, point);
        high = glm::max(high, point);
    }
    void add(const LevelBox& box) {
        low = glm::min(low, box.low);
        high = glm::max(high, box.high);
    }
    [[nodiscard]] bool empty() const { return low.x > high.x; }
};
using LevelBoxes = std::array<LevelBox, CellBoxes::kCells>;

/// Calls for every vertex that a vertex may come to, itself first, with the least level that must be asked
/// for, up to a last one.
template <typename Visit>
void follow(const Block& block, const Block* parent, std::uint32_t index, int last, Visit visit) {
    const Block* in = &block;
    visit(in->vertices[index], int{block.first_level});
    while (true) {
        const BlockVertex& vertex = in->vertices[index];
        const int gone = vertex.gone_level();
        if (gone == NestedMesh::kStays) {
            if (in == parent || parent == nullptr || vertex.next() == kNoVertex) return;
            in = parent;
            index = vertex.next();
            continue;
        }
        // It sets off as soon as more than the level before is asked for.
        if (gone > last) return;
        index = vertex.next();
        visit(in->vertices[index], std::max(gone, int{block.first_level}));
    }
}

Ecef middle(const Block& block) {
    Ecef sum{0.0};
    for (const BlockVertex& vertex : block.vertices) sum += position(vertex);
    return sum / static_cast<double>(block.vertices.size());
}

/// The boxes of all levels, in the local frame, not yet rounded.
std::vector<LevelBoxes> exact_boxes(const Block& block, const Block* parent, const CellBoxes& frame,
                                    std::size_t levels) {
    std::vector<LevelBoxes> boxes(levels);
    const glm::dmat3 to_local = glm::transpose(frame.axes);
    const int last = frame.first_level + static_cast<int>(levels) - 1;
    const NestedLevel& list = block.levels.front();
    std::vector<std::uint8_t> counted(block.vertices.size(), std::uint8_t{CellBoxes::kCells});
    for (std::size_t cell = 0; cell < CellBoxes::kCells; ++cell) {
        for (std::uint32_t i = list.cell_first[cell]; i < list.cell_first[cell + 1]; ++i) {
            const std::uint16_t vertex = block.indices[i];
            if (counted[vertex] == cell) continue;
            counted[vertex] = static_cast<std::uint8_t>(cell);
            follow(block, parent, vertex, last, [&](const BlockVertex& at, int level) {
                boxes[static_cast<std::size_t>(level - frame.first_level)][cell].add(
                    glm::vec3{to_local * (position(at) - frame.centre)});
            });
        }
        for (std::size_t level = 1; level < levels; ++level) boxes[level][cell].add(boxes[level - 1][cell]);
    }
    return boxes;
}

/// Steps of a coordinate, rounded outwards by at least a hundredth.
CellBoxes::Level rounded(const LevelBoxes& boxes, const CellBoxes& frame) {
    CellBoxes::Level result{};
    for (std::size_t cell = 0; cell < CellBoxes::kCells; ++cell) {
        if (boxes[cell].empty()) continue;
        const glm::vec3 low = glm::floor((boxes[cell].low - frame.origin) / frame.step_m - 0.01F);
        const glm::vec3 high = glm::ceil((boxes[cell].high - frame.origin) / frame.step_m + 0.01F);
        for (int axis = 0; axis < 3; ++axis) {
            const auto row = static_cast<std::size_t>(axis);
            result.low[row][cell] = static_cast<std::uint8_t>(std::clamp(low[axis], 0.0F, 255.0F));
            result.high[row][cell] = static_cast<std::uint8_t>(std::clamp(high[axis], 0.0F, 255.0F));
        }
    }
    return result;
}

}  // namespace

int last_box_level(const Block& block, const Block* parent) {
    if (parent == nullptr) return block.last_level;
    return std::min(block.last_level + CellBoxes::kLevelsBeyond, int{parent->last_level});
}

CellBoxes cell_boxes(const Block& block, const Block* parent) {
    CellBoxes result;
    if (block.levels.empty() || block.vertices.empty()) return result;
    result.first_level = block.first_level;
    result.centre = middle(block);
    result.axes = local_axes(result.centre);
    const int last = last_box_level(block, parent);
    const auto levels = static_cast<std::size_t>(last - block.first_level + 1);
    const std::vector<LevelBoxes> boxes = exact_boxes(block, parent, result, levels);
    LevelBox all;
    for (const LevelBox& box : boxes.back()) all.add(box);
    if (all.empty()) return result;
    // One step free at either end, for the rounding.
    result.step_m = glm::max((all.high - all.low) / 253.0F, glm::vec3{1e-3F});
    result.origin = all.low - result.step_m;
    result.radius_m = glm::length(glm::max(-all.low, all.high) + result.step_m);
    result.levels.reserve(levels);
    result.level_radius_m.reserve(levels);
    for (const LevelBoxes& level : boxes) {
        result.levels.push_back(rounded(level, result));
        LevelBox whole;
        for (const LevelBox& box : level) whole.add(box);
        result.level_radius_m.push_back(glm::length(glm::max(-whole.low, whole.high) + result.step_m));
    }
    return result;
}

}  // namespace eyepoint::terrain
