#include "terrain/lod/tile/tile_lod.hpp"

#include <algorithm>
#include <cstddef>

namespace eyepoint::terrain {

namespace {

/// log2 of the posts a side of the Earth's half circle: a tile's depth, plus the five halvings in its block.
constexpr int kBlockHalvings = 5;

int resolution(const TileNode& node) {
    return static_cast<int>(node.tile.depth) + kBlockHalvings - node.mark.level;
}

}  // namespace

const Selection& TileLod::select(const LodView& view, TileTree& tree, std::uint64_t frame) {
    cut_.update(view, view.tau_px, tree, frame);
    selection_.draws.clear();
    selection_.wishes = cut_.wishes();
    selection_.triangles = 0;
    selection_.blocks_tested = cut_.tested();
    leaves_.assign(cut_.leaves().begin(), cut_.leaves().end());
    choose_levels(view.tau_px);
    balance();
    emit();
    return selection_;
}

void TileLod::choose_levels(double tau_px) {
    for (TileNode* node : leaves_) {
        int level = kTileLevels - 1;
        while (level > 0 && cut_.error_px(*node, level) > tau_px) --level;
        node->mark.level = static_cast<std::int8_t>(level);
    }
}

void TileLod::balance() {
    by_resolution_.resize(kMaxDepth + kBlockHalvings + 1);
    for (TileNode* node : leaves_)
        by_resolution_[static_cast<std::size_t>(resolution(*node))].push_back(node);
    for (auto at = static_cast<int>(by_resolution_.size()) - 1; at >= 0; --at) {
        auto& bucket = by_resolution_[static_cast<std::size_t>(at)];
        for (const TileNode* node : bucket) {
            if (resolution(*node) != at) continue;  // raised since it was put here
            for (const Edge edge : kEdges) {
                for (TileNode* beside : cut_.across(*node, edge)) {
                    if (beside == nullptr || resolution(*beside) >= at - 1) continue;
                    beside->mark.level = static_cast<std::int8_t>(static_cast<int>(beside->tile.depth) +
                                                                  kBlockHalvings - (at - 1));
                    by_resolution_[static_cast<std::size_t>(at - 1)].push_back(beside);
                }
            }
        }
        bucket.clear();
    }
}

void TileLod::emit() {
    std::sort(leaves_.begin(), leaves_.end(),
              [](const TileNode* a, const TileNode* b) { return a->mark.distance_m < b->mark.distance_m; });
    for (const TileNode* node : leaves_) {
        unsigned thinned = 0;
        for (std::size_t edge = 0; edge < kEdges.size(); ++edge) {
            const auto beside = cut_.across(*node, kEdges[edge]);
            for (std::size_t half = 0; half < 2; ++half) {
                const bool coarser = beside[half] != nullptr && resolution(*beside[half]) < resolution(*node);
                thinned |= coarser ? 1U << (edge * 2 + half) : 0U;
            }
        }
        const IndexRange range = meshes_.range(node->mark.level, static_cast<std::uint8_t>(thinned));
        selection_.draws.push_back({node, range});
        selection_.triangles += range.count / 3;
    }
}

}  // namespace eyepoint::terrain
