#include "terrain/block/block.hpp"

#include <algorithm>

#include "terrain/block/block_vertex.hpp"

namespace eyepoint::terrain {

SplitPosition split(const Ecef& point) {
    const glm::vec3 high{point};
    const glm::vec3 low{point - glm::dvec3{high}};
    return {{high.x, high.y, high.z}, {low.x, low.y, low.z}};
}

double BlockVertex::height_msl_m() const { return kSurfaceFloorM + (rest >> kHeightShift); }

std::uint8_t BlockVertex::sides() const {
    const std::uint32_t x = place & 0xffffU, y = place >> 16;
    return static_cast<std::uint8_t>((x == 0 ? 1U : 0U) | (x == kVertexPlaceUnits ? 2U : 0U) |
                                     (y == 0 ? 4U : 0U) | (y == kVertexPlaceUnits ? 8U : 0U));
}

void BlockVertex::set_motion(std::uint32_t next, std::uint8_t gone_level) {
    const std::uint32_t field = std::min(std::uint32_t{gone_level}, kStaysField);
    rest = (rest & ~0U << kHeightShift) | field << kGoneShift | next;
}

std::size_t Block::bytes() const {
    return sizeof(Block) + vertices.capacity() * sizeof(BlockVertex) +
           relief.capacity() * sizeof(ReliefPost) + indices.capacity() * sizeof(std::uint16_t) +
           levels.capacity() * sizeof(NestedLevel) + fine_posts.capacity() * sizeof(NestedMesh::FinePost) +
           (bounds ? sizeof(CellBounds) : 0) + cell_boxes.levels.capacity() * sizeof(CellBoxes::Level) +
           (image ? image->rgb.capacity() : 0);
}

std::shared_ptr<const Block> unfold(BlockData data, std::optional<ImageData> image) {
    auto block = std::make_shared<Block>();
    block->vertices.reserve(kBlockVertices);
    const VertexMaker maker(data);
    for (int row = 0; row < kBlockPosts; ++row) {
        for (int column = 0; column < kBlockPosts; ++column)
            block->vertices.push_back(maker.at_post(row, column));
    }
    block->has_water =
        std::any_of(data.water.begin(), data.water.end(), [](std::uint8_t flag) { return flag != 0; });
    block->relief = relief_of(data);
    block->data = data;
    block->image = std::move(image);
    return block;
}

}  // namespace eyepoint::terrain
