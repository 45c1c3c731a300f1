#include "terrain/lod/nested_floors.hpp"

#include <vector>

#include "terrain/tiling/tile_edges.hpp"

namespace eyepoint::terrain {

namespace {

class FloorSpread {
  public:
    FloorSpread(std::span<BlockDraw> draws, TileTree& tree, std::uint64_t frame)
        : draws_(draws), tree_(tree), frame_(frame) {
        for (std::size_t i = 0; i < draws.size(); ++i) {
            if (TileNode* node = tree.find(draws[i].node->tile)) {
                node->mark = {.frame = frame, .draw = static_cast<std::uint32_t>(i)};
            }
        }
    }

    void raise(std::uint32_t draw, Edge edge, std::size_t half, std::uint8_t floor) {
        std::uint8_t& standing = draws_[draw].floors[static_cast<std::size_t>(edge) * 2 + half];
        if (standing >= floor) return;
        standing = floor;
        raised_.push_back({draw, edge, half});
    }

    void spread() {
        while (!raised_.empty()) {
            const HalfEdge half = raised_.back();
            raised_.pop_back();
            raise_across(half, draws_[half.draw].floors[static_cast<std::size_t>(half.edge) * 2 + half.half]);
        }
    }

  private:
    struct HalfEdge {
        std::uint32_t draw;
        Edge edge;
        std::size_t half;
    };

    [[nodiscard]] bool drawn(const TileNode& node) const { return node.mark.frame == frame_; }

    void raise_across(const HalfEdge& raised, std::uint8_t floor) {
        const TileId tile = draws_[raised.draw].node->tile;
        const auto beside = neighbour(tile, raised.edge);
        if (!beside) return;
        const Edge facing = opposite(raised.edge);
        const TileNode* node = &tree_.roots()[ancestor(*beside, 0).x];
        while (!drawn(*node) && node->tile.depth < beside->depth) {
            if (!node->children) return;
            const TileId next = ancestor(*beside, node->tile.depth + 1);
            node = &(*node->children)[static_cast<std::size_t>(quadrant(next))];
        }
        if (!drawn(*node)) {
            if (node->children) raise_all((*node->children)[children_at(facing)[raised.half]], facing, floor);
            return;
        }
        const std::uint32_t deeper = tile.depth - node->tile.depth;
        const bool upright = facing == Edge::West || facing == Edge::East;
        const std::uint32_t along = upright ? tile.y : tile.x;
        raise(node->mark.draw, facing, deeper == 0 ? raised.half : (along >> (deeper - 1)) & 1U, floor);
    }

    /// The whole edge of whatever is drawn in a tile.
    void raise_all(const TileNode& node, Edge edge, std::uint8_t floor) {
        if (drawn(node)) {
            for (const std::size_t half : {0U, 1U}) raise(node.mark.draw, edge, half, floor);
        } else if (node.children) {
            for (const std::size_t child : children_at(edge)) raise_all((*node.children)[child], edge, floor);
        }
    }

    std::span<BlockDraw> draws_;
    TileTree& tree_;
    std::uint64_t frame_;
    std::vector<HalfEdge> raised_;
};

}  // namespace

void spread_floors(std::span<BlockDraw> draws, std::span<const std::uint32_t> starved, TileTree& tree,
                   std::uint64_t frame) {
    FloorSpread floors(draws, tree, frame);
    for (const std::uint32_t draw : starved) {
        for (const Edge edge : kEdges) {
            for (const std::size_t half : {0U, 1U})
                floors.raise(draw, edge, half, draws[draw].node->info.first_level);
        }
    }
    floors.spread();
}

}  // namespace eyepoint::terrain
