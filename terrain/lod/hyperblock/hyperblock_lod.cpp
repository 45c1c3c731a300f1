#include "terrain/lod/hyperblock/hyperblock_lod.hpp"

#include <algorithm>
#include <cstddef>

#include "terrain/lod/hyperblock/eye_in_tile.hpp"
#include "terrain/lod/selective/block_posts.hpp"

namespace eyepoint::terrain {

using hyperblock::BlockChoice;
using hyperblock::HyperBlock;
using hyperblock::SelectBy;
using hyperblock::TileBlocks;
using selective::BorderSelection;

namespace {

/// The points on the tile's edges that the chosen triangulations have; on edges of blocks that are out of
/// view, all posts: then a dike there stays by the surface.
BorderSelection border_of(const TileBlocks& tile, const hyperblock::PointSet& points) {
    BorderSelection border{};
    for (std::size_t i = 0; i < tile.tree.blocks.size(); ++i) {
        const HyperBlock& block = tile.tree.blocks[i];
        const BlockChoice& choice = tile.choices[i];
        for (std::size_t edge = 0; edge < border.size(); ++edge) {
            const selective::EdgeVertices posts = block.on_tile_edge[edge];
            if (posts == 0) continue;
            const int level = block.depth + choice.level + (choice.border >> edge & 1);
            border[edge] |=
                choice.selected() ? posts & points.border[static_cast<std::size_t>(level)][edge] : posts;
        }
    }
    return border;
}

}  // namespace

HyperblockLod::HyperblockLod(const hyperblock::Options& options)
    : options_(options), cut_([this](const TileNode& node) { return excess_m(node); }) {
    options_.hyper_level = std::clamp(options.hyper_level, 0, hyperblock::kMostHyperLevel);
}

const Selection& HyperblockLod::select(const LodView& view, TileTree& tree, std::uint64_t frame) {
    const double blocks_tau_px = options_.blocks_tau_px;
    cut_.update(view, blocks_tau_px > 0.0 ? std::min(blocks_tau_px, view.tau_px) : view.tau_px, tree, frame);
    collect(frame);
    link_neighbours();
    if (options_.select_by == SelectBy::Block) {
        select_by_block(view);
    } else {
        select_by_vertex(view);
    }
    make_dikes();
    emit();
    return selection_;
}

double HyperblockLod::excess_m(const TileNode& node) {
    return twists_.of_m(node) + hyperblock::point_tolerance(node.tile, node.info).surface_m;
}

/// The cut's leaves, near to far.
void HyperblockLod::collect(std::uint64_t frame) {
    if (frame % kDropEvery == 0)
        std::erase_if(tiles_,
                      [&](const auto& entry) { return entry.second->used_frame + kHeldFrames < frame; });
    drawn_.clear();
    for (TileNode* node : cut_.leaves()) {
        std::unique_ptr<Held>& tile = tiles_[node->tile];
        if (!tile) tile = hold(*node);
        tile->used_frame = frame;
        drawn_.push_back(tile.get());
    }
    number_near_to_far(drawn_);
}

std::unique_ptr<HyperblockLod::Held> HyperblockLod::hold(TileNode& node) {
    auto tile = std::make_unique<Held>();
    tile->node = &node;
    tile->blocks.tile = node.tile;
    const float unseen_m = node.info.delta_m[0] + twists_.of_m(node);
    const selective::BlockPosts posts = selective::block_posts(*node.block, unseen_m);
    tile->origin = posts.origin;
    tile->points = hyperblock::point_set(posts, unseen_m, hyperblock::point_tolerance(node.tile, node.info));
    if (options_.select_by == SelectBy::Vertex) {
        tile->nested =
            std::make_unique<hyperblock::NestedPoints>(hyperblock::nested_points(posts, tile->points));
        return tile;
    }
    tile->blocks.tree =
        hyperblock::make_hyper_tree(*node.block, posts, unseen_m, tile->points, options_.hyper_level);
    tile->blocks.choices = hyperblock::no_choices(tile->blocks.tree);
    return tile;
}

void HyperblockLod::link_neighbours() {
    drawn_blocks_.clear();
    for (Held* tile : drawn_) drawn_blocks_.push_back(&tile->blocks);
    for (Held* tile : drawn_) {
        for (std::size_t edge = 0; edge < kEdges.size(); ++edge) {
            const auto leaves = cut_.across(*tile->node, kEdges[edge]);
            for (std::size_t half = 0; half < leaves.size(); ++half)
                tile->blocks.across[edge][half] =
                    leaves[half] == nullptr ? nullptr : drawn_blocks_[leaves[half]->mark.draw];
        }
    }
}

void HyperblockLod::select_by_block(const LodView& view) {
    const hyperblock::ScreenScale scale(view);
    for (Held* tile : drawn_) {
        const auto eye = hyperblock::eye_in_tile(view, tile->origin, tile->node->mark.distance_m);
        hyperblock::select_blocks(tile->blocks.tree, eye, scale, tile->blocks.choices);
    }
    adjustment_.adjust(drawn_blocks_);
    for (Held* tile : drawn_) {
        tile->changed = tile->in_mesh != tile->blocks.choices;
        if (tile->changed) put_together(*tile);
    }
}

void HyperblockLod::put_together(Held& tile) {
    const TileBlocks& blocks = tile.blocks;
    tile.in_mesh = blocks.choices;
    tile.blocks.border = border_of(blocks, tile.points);
    tile.mesh.indices.clear();
    for (std::size_t i = 0; i < blocks.choices.size(); ++i) {
        const BlockChoice& choice = blocks.choices[i];
        if (!choice.selected()) continue;
        const auto strip = blocks.tree.strip(blocks.tree.blocks[i], choice.level, choice.border);
        tile.mesh.indices.insert(tile.mesh.indices.end(), strip.begin(), strip.end());
    }
    tile.own_indices = tile.mesh.indices.size();
}

void HyperblockLod::select_by_vertex(const LodView& view) {
    const hyperblock::ScreenScale scale(view);
    for (Held* tile : drawn_) {
        const auto eye = hyperblock::eye_in_tile(view, tile->origin, tile->node->mark.distance_m);
        made_.clear();
        tile->blocks.border = hyperblock::select_vertices(tile->points, *tile->nested, eye, scale, made_);
        const std::span own = std::span{tile->mesh.indices}.first(tile->own_indices);
        tile->changed = !std::ranges::equal(own, made_);
        if (!tile->changed) continue;
        tile->mesh.indices.assign(made_.begin(), made_.end());
        tile->own_indices = made_.size();
    }
}

void HyperblockLod::make_dikes() {
    for (Held* tile : drawn_) {
        const auto& across = tile->blocks.across;
        const selective::FarSides far = selective::far_sides(
            tile->blocks.tile, tile->blocks.border,
            [&](Edge edge) { return across[static_cast<std::size_t>(edge)]; },
            [](const TileBlocks& beside) { return beside.border; });
        tile->changed = tile->changed || far != tile->far_sides;
        if (!tile->changed) continue;
        tile->far_sides = far;
        tile->mesh.indices.resize(tile->own_indices);
        selective::append_dikes(far, tile->blocks.border, tile->node->block->data, tile->mesh.indices);
        tile->mesh.version = ++version_;
    }
}

void HyperblockLod::emit() {
    selection_.draws.clear();
    selection_.wishes = cut_.wishes();
    selection_.triangles = 0;
    selection_.blocks_tested = cut_.tested();
    selection_.blocks_chosen = selection_.blocks_reused = 0;
    for (const Held* tile : drawn_) {
        ++(tile->changed ? selection_.blocks_chosen : selection_.blocks_reused);
        const auto count = static_cast<std::uint32_t>(tile->mesh.indices.size());
        if (count == 0) continue;  // its box is in view, none of its blocks is
        selection_.draws.push_back({tile->node, {0, count}, shown_level(count / 3), {}, &tile->mesh});
        selection_.triangles += count / 3;
    }
}

std::uint64_t HyperblockLod::hyper_blocks() const {
    std::uint64_t count = 0;
    for (const Held* tile : drawn_) {
        const auto& choices = tile->blocks.choices;
        count += static_cast<std::uint64_t>(
            std::ranges::count_if(choices, [](const BlockChoice& choice) { return choice.selected(); }));
    }
    return count;
}

std::uint64_t HyperblockLod::dike_triangles() const {
    std::uint64_t count = 0;
    for (const Held* tile : drawn_) count += (tile->mesh.indices.size() - tile->own_indices) / 3;
    return count;
}

}  // namespace eyepoint::terrain
