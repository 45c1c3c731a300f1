#include "terrain/lod/tile/tile_lod.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>

#include "terrain/lod/twist.hpp"
#include "terrain/tiling/tile_edges.hpp"

namespace eyepoint::terrain {

using tiles::Tile;
using tiles::TiledBlock;

namespace {

constexpr std::size_t kResolutions = kMaxDepth + Tile::kBlockHalvings + 1;

}  // namespace

TileLod::TileLod(const tiles::Options& options)
    : options_(options),
      division_(tiles::division(options.posts)),
      meshes_(division_),
      cut_([this](TileNode& node) { return block_of(node).excess_m; },
           options.morph ? TileCut::Keep{[this](const TileNode& node) { return keeps(node); }}
                         : TileCut::Keep{}),
      clock_(options.clock) {}

const Selection& TileLod::select(const LodView& view, TileTree& tree, std::uint64_t frame) {
    frame_ = frame;
    clock_.tick(view);
    cut_.update(view, view.tau_px, tree, frame);
    collect(view);
    link();
    want(view);
    morph();
    emit();
    if (frame % kDropEvery == 0) drop_unused();
    return selection_;
}

std::size_t TileLod::unsettled() const {
    return static_cast<std::size_t>(std::count_if(tiles_.begin(), tiles_.end(), [](const Tile* tile) {
        return tile->slid != 0.0 || tile->wanted != tile->drawn.resolution;
    }));
}

TiledBlock& TileLod::block_of(TileNode& node) {
    std::unique_ptr<TiledBlock>& block = blocks_[node.tile];
    if (!block) block = std::make_unique<TiledBlock>(tiles::tiled(node, division_));
    block->touched_frame = frame_;
    return *block;
}

void TileLod::drop_unused() {
    std::erase_if(blocks_,
                  [&](const auto& entry) { return entry.second->touched_frame + kHeldFrames < frame_; });
}

Tile* TileLod::tile_in(TiledBlock& block, TileId place) const {
    const auto parts = static_cast<std::uint32_t>(division_.parts);
    return &block.tiles[place.y % parts * parts + place.x % parts];
}

const Tile* TileLod::drawn_before(const TileNode& node, TileId place) const {
    const auto found = blocks_.find(node.tile);
    if (found == blocks_.end() || found->second->drawn_frame + 1 != frame_) return nullptr;
    return tile_in(*found->second, place);
}

Tile* TileLod::drawn_tile(const TileNode& node, TileId place) const {
    const LodMark& mark = node.mark;
    if (mark.frame != frame_ || !mark.visible || mark.split) return nullptr;
    return tile_in(*drawn_[mark.draw], place);
}

/// Whether a block that would do by itself is not drawn yet, because its children's tiles have not come to
/// what it would draw.
bool TileLod::keeps(const TileNode& node) const {
    if (clock_.leapt(node.mark.distance_m)) return false;
    for (const TileNode& child : *node.children) {
        if (child.mark.frame + 1 == frame_ && child.mark.split) return true;
    }
    const auto parts = static_cast<std::uint32_t>(division_.parts);
    const auto deeper = static_cast<std::uint32_t>(std::countr_zero(parts));
    for (std::uint32_t part = 0; part < parts * parts; ++part) {
        const TileId place{node.tile.depth + deeper, node.tile.x * parts + part % parts,
                           node.tile.y * parts + part / parts};
        if (!can_take_over(node, place)) return true;
    }
    return false;
}

/// Whether the four tiles in a tile's place are drawn as it could be.
bool TileLod::can_take_over(const TileNode& node, TileId place) const {
    const Tile* first = nullptr;
    for (int q = 0; q < 4; ++q) {
        const TileId part = child(place, q);
        const auto quarter = static_cast<std::size_t>(quadrant(ancestor(part, node.tile.depth + 1)));
        const Tile* tile = drawn_before((*node.children)[quarter], part);
        if (tile == nullptr) continue;
        if (first == nullptr) first = tile;
        if (tile->slid != 0.0 || tile->drawn != first->drawn) return false;
    }
    if (first == nullptr) return true;
    const int level = first->level_of(first->drawn.resolution) - 1;
    return level >= 0 && level < division_.levels;
}

/// The cut's leaves, near to far.
void TileLod::collect(const LodView& view) {
    drawn_.clear();
    tiles_.clear();
    for (TileNode* node : cut_.leaves()) drawn_.push_back(&block_of(*node));
    number_near_to_far(drawn_);
    for (TiledBlock* block : drawn_) begin(*block, view);
}

void TileLod::begin(TiledBlock& block, const LodView& view) {
    const TileNode& node = *block.node;
    const bool fresh = block.drawn_frame + 1 != frame_;
    const bool held = node.parent != nullptr && !cut_.too_coarse(*node.parent);
    for (Tile& tile : block.tiles) {
        tile.fresh = fresh;
        tile.held = held;
        tile.distance_m = division_.parts == 1 ? node.mark.distance_m : distance_m(tile.bounds, view.eye);
        tiles_.push_back(&tile);
    }
}

void TileLod::link() {
    for (Tile* tile : tiles_) {
        for (std::size_t edge = 0; edge < kEdges.size(); ++edge) {
            const auto beside = across(*tile, kEdges[edge]);
            tile->beside[2 * edge] = beside[0];
            tile->beside[2 * edge + 1] = beside[1];
        }
    }
}

/// The tiles across an edge, by half.
std::array<Tile*, 2> TileLod::across(const Tile& tile, Edge edge) const {
    const auto beside = neighbour(tile.place, edge);
    if (!beside) return {nullptr, nullptr};
    const TileId own = tile.node->tile;
    if (ancestor(*beside, own.depth) == own) {
        Tile* inside = tile_in(*drawn_[tile.node->mark.draw], *beside);
        return {inside, inside};
    }
    const auto nodes = cut_.across(*tile.node, edge);
    const TileNode* any = nodes[0] != nullptr ? nodes[0] : nodes[1];
    if (any == nullptr) return {nullptr, nullptr};
    if (any->tile.depth <= own.depth) {
        Tile* one = drawn_tile(*any, any->tile.depth == own.depth ? *beside : parent(*beside));
        return {one, one};
    }
    std::array<Tile*, 2> halves{};
    const auto touching = children_at(opposite(edge));
    for (std::size_t half = 0; half < 2; ++half) {
        const TileId place = child(*beside, static_cast<int>(touching[half]));
        for (const TileNode* node : nodes) {
            if (node != nullptr && ancestor(place, node->tile.depth) == node->tile)
                halves[half] = drawn_tile(*node, place);
        }
    }
    return halves;
}

int TileLod::resolution_wanted(const Tile& tile, double distance, double tau_px) const {
    int level = division_.levels - 1;
    while (level > 0 &&
           cut_.error_px(*tile.node, level, double{tile.error_m[static_cast<std::size_t>(level)]}, distance) >
               tau_px)
        --level;
    return tile.resolution_of(level);
}

void TileLod::want(const LodView& view) {
    for (Tile* tile : tiles_) {
        tile->wanted = resolution_wanted(*tile, tile->distance_m, view.tau_px);
        if (tile->held) want_as_parent(*tile, view);
    }
    balance_wanted();
}

/// What its parent in the parent's block wants, as far as the tile can be drawn so.
void TileLod::want_as_parent(Tile& tile, const LodView& view) {
    TileNode& node = *tile.node->parent;
    const Tile& above = *tile_in(block_of(node), parent(tile.place));
    const int resolution = resolution_wanted(above, distance_m(above.bounds, view.eye), view.tau_px);
    tile.wanted = std::max(resolution, tile.resolution_of(division_.levels - 1));
}

/// Neighbours one apart at most, by making the coarser one finer; what has to be alike to give way to its
/// parent, alike.
void TileLod::balance_wanted() {
    by_resolution_.resize(kResolutions);
    for (Tile* tile : tiles_) by_resolution_[static_cast<std::size_t>(tile->wanted)].push_back(tile);
    for (auto at = static_cast<int>(kResolutions) - 1; at >= 0; --at) {
        auto& bucket = by_resolution_[static_cast<std::size_t>(at)];
        const auto raise = [&](Tile* tile, int to) {
            if (tile == nullptr || tile->wanted >= to) return;
            tile->wanted = to;
            by_resolution_[static_cast<std::size_t>(to)].push_back(tile);
        };
        for (std::size_t i = 0; i < bucket.size(); ++i) {
            const Tile& tile = *bucket[i];
            if (tile.wanted != at) continue;  // raised since it was put here
            for (Tile* beside : tile.beside) raise(beside, at - 1);
            for (int q = 0; tile.held && q < 4; ++q) {
                const TileId place = child(parent(tile.place), q);
                const TileNode& node = division_.parts > 1
                                           ? *tile.node
                                           : (*tile.node->parent->children)[static_cast<std::size_t>(q)];
                raise(drawn_tile(node, place), at);
            }
        }
        bucket.clear();
    }
}

void TileLod::morph() {
    switched_ = 0;
    for (Tile* tile : tiles_) {
        if (!options_.morph || clock_.leapt(tile->distance_m)) {
            tile->set(tile->wanted, 0.0);
        } else if (tile->fresh) {
            take_up(*tile);
        }
        const int level = tile->level_of(tile->drawn.resolution);
        tile->error_px = cut_.error_px(
            *tile->node, level, double{tile->error_m[static_cast<std::size_t>(level)]}, tile->distance_m);
    }
    if (options_.morph) {
        slide_on(tiles_, clock_);
        switched_ = queue_.run(tiles_, clock_, options_.rebuilds);
        settle();
    }
}

/// How a tile begins that was not drawn in the frame before: as what was drawn in its place, so that nothing
/// changes; as it is wanted where nothing was, or something that was too coarse for want of blocks.
void TileLod::take_up(Tile& tile) const {
    tile.set(tile.wanted, 0.0);
    const TileNode& node = *tile.node;
    const int coarsest = tile.resolution_of(division_.levels - 1), finest = tile.resolution_of(0);
    if (node.parent != nullptr) {
        const auto above = blocks_.find(node.parent->tile);
        const bool drawn = above != blocks_.end() && above->second->drawn_frame + 1 == frame_;
        if (drawn && above->second->starved) return;
        if (drawn) {
            const Tile& from = *tile_in(*above->second, parent(tile.place));
            if (from.drawn.resolution > coarsest) return tile.set(from.drawn.resolution, from.slid);
            return tile.set(coarsest, 0.0);
        }
    }
    if (!node.children) return;
    int resolution = -1;
    for (int q = 0; q < 4; ++q) {
        const TileId part = child(tile.place, q);
        const auto quarter = static_cast<std::size_t>(quadrant(ancestor(part, node.tile.depth + 1)));
        const Tile* from = drawn_before((*node.children)[quarter], part);
        if (from != nullptr) resolution = std::max(resolution, from->drawn.resolution);
    }
    if (resolution >= 0) tile.set(std::clamp(resolution, coarsest, finest), 0.0);
}

/// What is drawn is one apart at most between neighbours, whatever came into view beside what: by the finer
/// mesh, slid to where the coarser one is.
void TileLod::settle() {
    for (Tile* tile : tiles_)
        by_resolution_[static_cast<std::size_t>(tile->drawn.resolution)].push_back(tile);
    for (auto at = static_cast<int>(kResolutions) - 1; at >= 0; --at) {
        auto& bucket = by_resolution_[static_cast<std::size_t>(at)];
        for (const Tile* tile : bucket) {
            if (tile->drawn.resolution != at) continue;  // raised since it was put here
            for (Tile* beside : tile->beside) {
                if (beside == nullptr || beside->drawn.resolution >= at - 1) continue;
                beside->set(at - 1, beside->fresh ? 0.0 : 1.0);
                by_resolution_[static_cast<std::size_t>(at - 1)].push_back(beside);
            }
        }
        bucket.clear();
    }
}

void TileLod::emit() {
    selection_.draws.clear();
    selection_.wishes = cut_.wishes();
    selection_.triangles = 0;
    selection_.blocks_tested = cut_.tested();
    selection_.blocks_chosen = 0;
    for (TiledBlock* block : drawn_) {
        bool changed = block->drawn_frame + 1 != frame_;
        for (Tile& tile : block->tiles) {
            std::array<const tiles::Fineness*, 8> beside{};
            for (std::size_t i = 0; i < beside.size(); ++i)
                beside[i] = tile.beside[i] != nullptr ? &tile.beside[i]->drawn : nullptr;
            const int level = tile.level_of(tile.drawn.resolution);
            const TileSlide slide = tiles::slide_of(tile.part, level, tile.drawn, beside);
            const IndexRange range = meshes_.range(tile.part, level, slide.stitched);
            changed = changed || range.first != tile.mesh.first;
            tile.mesh = range;
            selection_.draws.push_back(
                {block->node, range, static_cast<std::uint8_t>(level), {}, nullptr, slide});
            selection_.triangles += range.count / 3;
        }
        block->drawn_frame = frame_;
        block->starved = cut_.too_coarse(*block->node);
        selection_.blocks_chosen += changed ? 1 : 0;
    }
    selection_.blocks_reused = static_cast<std::uint32_t>(drawn_.size()) - selection_.blocks_chosen;
}

}  // namespace eyepoint::terrain
