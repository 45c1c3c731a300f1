#include "terrain/lod/bintree/bintree_lod.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

#include "terrain/lod/triangle_arc.hpp"

namespace eyepoint::terrain {

using bintree::Across;
using bintree::BlockNumber;
using bintree::Code;
using bintree::CodeSet;
using bintree::kFinestLevel;
using bintree::kNoBlock;

namespace {

/// What a block may use of the tolerance where it is drawn with all its posts; the rest is its triangles'.
/// The less, the more blocks and the fewer triangles (docs/methods/bintree.md has the figures).
constexpr double kBlockShare = 0.5;

/// A budget raises the tolerance to this at most.
constexpr double kMostTauPx = 1000.0;
constexpr int kMostTries = 16;

/// Left of a margin after it was worked out in floats.
constexpr double kMarginKept = 0.999;

float distance_m(const BlockVertex& vertex, const SplitPosition& eye) {
    const auto along = [&](std::size_t axis) {
        return (vertex.high[axis] - eye.high[axis]) + (vertex.low[axis] - eye.low[axis]);
    };
    return glm::length(glm::vec3{along(0), along(1), along(2)});
}

bool same_scale(const LodView& a, const LodView& b) {
    return a.kappa_px == b.kappa_px && a.tau_px == b.tau_px && a.near_m == b.near_m;
}

}  // namespace

const Selection& BintreeLod::select(const LodView& view, TileTree& tree, std::uint64_t frame) {
    LodView in_force = view;
    if (triangle_budget_ > 0) in_force.tau_px = std::max(view.tau_px, view_.tau_px);
    cut_.update(view, kBlockShare * tolerance_of_blocks(in_force.tau_px), tree, frame);
    odometer_m_ += glm::distance(view.eye, view_.eye);
    selection_.blocks_chosen = 0;
    if (enter_and_leave(frame)) conjoin(frame);
    shape(in_force);
    if (triangle_budget_ > 0) fit(view);
    emit();
    return selection_;
}

/// The tolerance in force, but for the small moves that keep a budget: other blocks make other triangles, and
/// the two would follow each other to and fro.
double BintreeLod::tolerance_of_blocks(double tau_px) {
    constexpr double kMostRatio = 1.25;
    const double ratio = tau_px / blocks_tau_px_;
    const bool near = triangle_budget_ > 0 && ratio < kMostRatio && ratio > 1.0 / kMostRatio;
    if (!near) blocks_tau_px_ = tau_px;
    return blocks_tau_px_;
}

/// Moves the tolerance in force until the triangles are within the budget and not far below. Their number
/// falls about with the tolerance; where it jumps, the search ends between two tolerances, at the greater.
void BintreeLod::fit(const LodView& view) {
    constexpr double kLeastUse = 0.94, kAim = 0.97, kNarrow = 1.002;
    double too_small_px = 0.0, fitting_px = 0.0;  // none yet
    LodView in_force = view;
    for (int tries = 0; tries < kMostTries; ++tries) {
        const double tau_px = view_.tau_px, use = static_cast<double>(triangles()) / triangle_budget_;
        if (use <= 1.0 && (use >= kLeastUse || tau_px <= view.tau_px)) return;
        (use > 1.0 ? too_small_px : fitting_px) = tau_px;
        const bool between = too_small_px > 0.0 && fitting_px > 0.0;
        if (between && fitting_px < too_small_px * kNarrow) break;
        in_force.tau_px = between ? std::sqrt(too_small_px * fitting_px)
                                  : std::clamp(tau_px * use / kAim, view.tau_px, kMostTauPx);
        if (in_force.tau_px == tau_px) return;
        shape(in_force);
    }
    in_force.tau_px = fitting_px;
    if (fitting_px > 0.0 && view_.tau_px != fitting_px) shape(in_force);
}

void BintreeLod::shape(const LodView& view) {
    judge(view);
    refine();
    simplify();
    view_ = view;
}

std::uint64_t BintreeLod::triangles() const {
    std::uint64_t count = 2 * drawn_.size();
    for (const BlockNumber number : drawn_) count += forest_.split_nodes(number).size();
    return count;
}

/// Blocks that are in the cut for the first time get a tree, those that are not any more lose it. False if
/// there are none of either.
bool BintreeLod::enter_and_leave(std::uint64_t frame) {
    drawn_.clear();
    bool changed = false;
    for (const TileNode* node : cut_.leaves()) {
        const auto known = numbers_.find(node->tile);
        if (known == numbers_.end()) continue;
        blocks_[known->second].seen_frame = frame;
    }
    for (auto entry = numbers_.begin(); entry != numbers_.end();) {
        if (blocks_[entry->second].seen_frame == frame) {
            ++entry;
            continue;
        }
        forest_.remove(entry->second);
        entry = numbers_.erase(entry);
        changed = true;
    }
    for (const TileNode* node : cut_.leaves()) {
        const auto [entry, fresh] = numbers_.try_emplace(node->tile, kNoBlock);
        if (fresh) {
            entry->second = forest_.add(node->tile);
            if (entry->second >= blocks_.size()) blocks_.resize(entry->second + 1);
            Active& block = blocks_[entry->second];
            block.node = node;
            block.seen_frame = block.entered_frame = frame;
            block.vertices = bintree::split_vertices(*node->block);
            block.wanted = {};
            block.judge_again_m = 0.0;
            changed = true;
        }
        drawn_.push_back(entry->second);
    }
    return changed;
}

Across BintreeLod::across(const TileNode& node, Edge edge) const {
    const auto leaves = cut_.across(node, edge);
    const auto number = [&](const TileNode* leaf) {
        return leaf == nullptr ? kNoBlock : numbers_.find(leaf->tile)->second;
    };
    if (leaves[0] != leaves[1]) return {Across::Kind::Finer, {number(leaves[0]), number(leaves[1])}};
    if (leaves[0] == nullptr) return {};
    const bool same = leaves[0]->tile.depth == node.tile.depth;
    return {same ? Across::Kind::Same : Across::Kind::Coarser, {number(leaves[0]), kNoBlock}};
}

bool BintreeLod::is_new(const Across& across, std::uint64_t frame) const {
    return std::any_of(across.blocks.begin(), across.blocks.end(), [&](BlockNumber number) {
        return number != kNoBlock && blocks_[number].entered_frame == frame;
    });
}

void BintreeLod::conjoin(std::uint64_t frame) {
    to_conjoin_.clear();
    for (const BlockNumber number : drawn_) {
        Active& block = blocks_[number];
        for (const Edge edge : kEdges) {
            const Across now = across(*block.node, edge);
            if (now == forest_.across(number, edge) && block.entered_frame != frame && !is_new(now, frame))
                continue;
            forest_.link(number, edge, now);
            to_conjoin_.emplace_back(number, edge);
            block.check_splits = true;
        }
    }
    for (const auto& [number, edge] : to_conjoin_) forest_.conjoin(number, edge);
}

void BintreeLod::judge(const LodView& view) {
    const bool rescaled = !same_scale(view, view_);
    for (const BlockNumber number : drawn_) {
        Active& block = blocks_[number];
        if (!rescaled && odometer_m_ < block.judge_again_m) continue;
        ++selection_.blocks_chosen;
        const Judgement judgement = judge(block, view);
        block.judge_again_m = odometer_m_ + kMarginKept * judgement.margin_m;
        if (judgement.wanted == block.wanted) continue;
        block.wanted = judgement.wanted;
        block.check_splits = true;
    }
}

/// From the roots down, to the first nodes that are not wanted: vertices are nested, so none below them is.
BintreeLod::Judgement BintreeLod::judge(const Active& block, const LodView& view) const {
    const TileNode& node = *block.node;
    const auto& triangles = bintree::block_triangles(bintree::diagonal_of(node.tile));
    const SplitPosition eye = split(view.eye);
    const double reach_a_metre = view.kappa_px / view.tau_px;
    std::array<double, kFinestLevel> least_reach_m{};
    for (int level = 0; level < kFinestLevel; ++level)
        least_reach_m[static_cast<std::size_t>(level)] =
            view.kappa_px / kHorizonPx * arc_height_m(node.tile.depth, level);

    Judgement result{{}, std::numeric_limits<double>::max()};
    std::array<Code, kFinestLevel + 2> stack{bintree::kRootA, bintree::kRootB};
    std::size_t waiting = 2;
    while (waiting > 0) {
        const Code code = stack[--waiting];
        const int level = bintree::level(code);
        const std::uint16_t middle = triangles[code].middle;
        const bintree::SplitVertex& vertex = block.vertices[middle];
        const double reach_m =
            std::max(reach_a_metre * (double{vertex.error.metres()} + node.info.delta_m[0]),
                     least_reach_m[static_cast<std::size_t>(level)]);
        if (reach_m <= view.near_m) continue;
        const double beyond_m =
            double{distance_m(node.block->vertices[middle], eye)} - double{vertex.radius.metres()} - reach_m;
        result.margin_m = std::min(result.margin_m, std::abs(beyond_m));
        if (beyond_m >= 0.0) continue;
        result.wanted.insert(code);
        if (level + 1 == kFinestLevel) continue;
        stack[waiting++] = bintree::right_child(code);
        stack[waiting++] = bintree::left_child(code);
    }
    return result;
}

void BintreeLod::refine() {
    for (const BlockNumber number : drawn_) {
        const CodeSet lacking = blocks_[number].wanted.without(forest_.split_nodes(number));
        lacking.for_each([&](Code code) { (void)forest_.split(number, code); });
    }
}

/// Finest level first, all blocks level by level: a merge makes others possible in the levels above alone.
void BintreeLod::simplify() {
    for (const BlockNumber number : drawn_) {
        Active& block = blocks_[number];
        block.check_splits = block.check_splits || forest_.changed(number);
    }
    for (int level = kFinestLevel - 1; level >= 0; --level) {
        for (const BlockNumber number : drawn_) {
            if (blocks_[number].check_splits) simplify(number, level);
        }
    }
    for (const BlockNumber number : drawn_) blocks_[number].check_splits = false;
}

void BintreeLod::simplify(BlockNumber number, int level) {
    const CodeSet spare = forest_.split_nodes(number).without(blocks_[number].wanted);
    spare.for_each_of_level(level, [&](Code code) {
        if (!forest_.is_split(number, code)) return;
        const auto partner = forest_.partner(number, code);
        const bool shared = partner.kind == bintree::Forest::Partner::Kind::Node;
        if (shared && blocks_[partner.block].wanted.has(partner.code)) return;
        if (forest_.fold(number, code) && shared) blocks_[partner.block].check_splits = true;
    });
}

void BintreeLod::emit() {
    std::sort(drawn_.begin(), drawn_.end(), [&](BlockNumber a, BlockNumber b) {
        return blocks_[a].node->mark.distance_m < blocks_[b].node->mark.distance_m;
    });
    selection_.draws.clear();
    selection_.wishes = cut_.wishes();
    selection_.triangles = 0;
    selection_.blocks_tested = cut_.tested();
    const auto blocks = static_cast<std::uint32_t>(drawn_.size());
    selection_.blocks_reused = blocks - std::min(blocks, selection_.blocks_chosen);
    for (const BlockNumber number : drawn_) {
        BlockMesh& mesh = blocks_[number].mesh;
        if (forest_.take_changed(number)) {
            mesh.indices.clear();
            forest_.append_triangles(number, mesh.indices);
            mesh.version = ++version_;
        }
        const auto count = static_cast<std::uint32_t>(mesh.indices.size());
        selection_.draws.push_back({blocks_[number].node, {0, count}, shown_level(count / 3), {}, &mesh});
        selection_.triangles += count / 3;
    }
}

}  // namespace eyepoint::terrain
