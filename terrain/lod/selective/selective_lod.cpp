#include "terrain/lod/selective/selective_lod.hpp"

#include <algorithm>
#include <cstddef>

#include <glm/geometric.hpp>

#include "terrain/lod/selective/dike.hpp"
#include "terrain/lod/selective/screen_error.hpp"

namespace eyepoint::terrain {

using selective::kRanks;
using selective::Rank;
using selective::ReuseTest;

namespace {

/// What a block may use of the tolerance where it is drawn with all its posts; the rest is its selection's.
/// The less, the more blocks and the fewer triangles.
constexpr double kWholeBlockShare = 0.7;

/// Left of what a selection stands for after it was worked out in floats.
constexpr double kStandingKept = 0.999;

Ecef corner(const Block& block, int row, int column) {
    return block.vertices[static_cast<std::size_t>(row * kBlockPosts + column)].position();
}

}  // namespace

const Selection& SelectiveLod::select(const LodView& view, TileTree& tree, std::uint64_t frame) {
    cut_.update(view, kWholeBlockShare * view.tau_px, tree, frame);
    odometer_m_ += glm::distance(view.eye, eye_);
    eye_ = view.eye;
    collect(frame);
    select_vertices(view);
    make_dikes();
    emit();
    return selection_;
}

/// The cut's leaves, near to far.
void SelectiveLod::collect(std::uint64_t frame) {
    if (frame % kDropEvery == 0) drop_unused(frame);
    drawn_.clear();
    for (TileNode* node : cut_.leaves()) {
        std::unique_ptr<Held>& block = blocks_[node->tile];
        if (!block) block = hold(*node);
        block->used_frame = frame;
        drawn_.push_back(block.get());
    }
    number_near_to_far(drawn_);
}

void SelectiveLod::drop_unused(std::uint64_t frame) {
    std::erase_if(blocks_, [&](const auto& entry) { return entry.second->used_frame + kHeldFrames < frame; });
}

std::unique_ptr<SelectiveLod::Held> SelectiveLod::hold(TileNode& node) {
    auto block = std::make_unique<Held>();
    block->node = &node;
    block->posts = selective::block_posts(*node.block, node.info.delta_m[0] + twists_.of_m(node));
    block->corners = {corner(*node.block, 0, 0), corner(*node.block, 0, kBlockCells),
                      corner(*node.block, kBlockCells, 0), corner(*node.block, kBlockCells, kBlockCells)};
    return block;
}

void SelectiveLod::select_vertices(const LodView& view) {
    selection_.blocks_chosen = selection_.blocks_reused = 0;
    for (Held* block : drawn_) {
        block->changed = !stands(*block, view);
        if (block->changed) select_anew(*block, view);
        ++(block->changed ? selection_.blocks_chosen : selection_.blocks_reused);
    }
}

bool SelectiveLod::stands(const Held& block, const LodView& view) const {
    if (options_.reuse == ReuseTest::Off || !selective::same_scale(block.selected_for, view)) return false;
    if (options_.reuse == ReuseTest::Sound) return odometer_m_ <= block.selected_for.stands_to_m;
    const TileNode& node = *block.node;
    const bool outside = node.mark.distance_m > 0.0 && distance_m(node.bounds, block.selected_for.eye) > 0.0;
    return outside && selective::four_corner_test(options_.error, block.corners, glm::dvec3{block.posts.up},
                                                  block.selected_for, view.eye);
}

void SelectiveLod::select_anew(Held& block, const LodView& view) {
    selective::test_posts(options_.error, block.posts,
                          selective::block_view(view, block.posts, block.node->mark.distance_m), tested_);
    block.mesh.indices.clear();
    block.selection.select(tested_, block.mesh.indices);
    block.own_indices = block.mesh.indices.size();
    block.selected_for = {view.eye, view.kappa_px, view.tau_px, view.slack_px,
                          odometer_m_ + kStandingKept * static_cast<double>(block.selection.stands_for_m())};
}

void SelectiveLod::make_dikes() {
    for (Held* block : drawn_) {
        const TileNode& node = *block->node;
        const selective::FarSides far = selective::far_sides(
            node.tile, block->selection.border(), [&](Edge edge) { return cut_.across(node, edge); },
            [&](const TileNode& leaf) { return held(leaf).selection.border(); });
        if (!block->changed && far == block->far_sides) continue;
        block->far_sides = far;
        block->mesh.indices.resize(block->own_indices);
        selective::append_dikes(far, block->selection.border(), node.block->data, block->mesh.indices);
        block->mesh.version = ++version_;
    }
}

void SelectiveLod::emit() {
    selection_.draws.clear();
    selection_.wishes = cut_.wishes();
    selection_.triangles = 0;
    selection_.blocks_tested = cut_.tested();
    for (const Held* block : drawn_) {
        const auto count = static_cast<std::uint32_t>(block->mesh.indices.size());
        selection_.draws.push_back({block->node, {0, count}, shown_level(count / 3), {}, &block->mesh});
        selection_.triangles += count / 3;
    }
}

SelectionAudit SelectiveLod::audit(const LodView& view) const {
    SelectionAudit sum;
    selective::TestedPosts at_tau;
    for (const Held* block : drawn_) {
        const selective::BlockView from =
            selective::block_view(view, block->posts, block->node->mark.distance_m);
        selective::test_posts(options_.error, block->posts, from, at_tau);
        sum.dike_triangles += (block->mesh.indices.size() - block->own_indices) / 3;
        for (Rank rank = 0; rank < kRanks; ++rank) {
            if (block->selection.active(rank)) {
                ++sum.selected;
                continue;
            }
            const double error_px = selective::error_px(options_.error, block->posts, rank, from);
            sum.worst_px = std::max(sum.worst_px, error_px);
            if (at_tau.passes_by[rank] < 0.0F) ++sum.missed;
            if (error_px > view.tau_px + view.slack_px) ++sum.too_far;
        }
    }
    return sum;
}

void SelectionAudit::merge(const SelectionAudit& other) {
    selected += other.selected;
    missed += other.missed;
    too_far += other.too_far;
    worst_px = std::max(worst_px, other.worst_px);
    dike_triangles += other.dike_triangles;
}

}  // namespace eyepoint::terrain
