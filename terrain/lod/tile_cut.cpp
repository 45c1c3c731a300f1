#include "terrain/lod/tile_cut.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <glm/geometric.hpp>

#include "terrain/geodesy/earth.hpp"
#include "terrain/lod/painted_detail.hpp"
#include "terrain/lod/planet_horizon.hpp"
#include "terrain/tiling/tile_edges.hpp"

namespace eyepoint::terrain {

namespace {

/// Height of the Earth's arc over the diagonal of a cell of a level, at the equator, where it is greatest,
/// metres.
double sagitta_m(std::uint32_t depth, int level) {
    constexpr double kRadiansPerDegree = 3.14159265358979323846 / 180.0;
    const double chord_m = post_spacing_deg(depth) * (1 << level) * kRadiansPerDegree * kEquatorialRadiusM;
    return 2.0 * chord_m * chord_m / (8.0 * kEquatorialRadiusM);
}

}  // namespace

void TileCut::update(const LodView& view, double tau_px, TileTree& tree, std::uint64_t frame) {
    view_ = view;
    tau_px_ = tau_px;
    tree_ = &tree;
    frame_ = frame;
    const double lowest_m = tree.lowest_height_m();
    horizon_ = HorizonOccluder{view.eye, lowest_m - mesh_below_surface_m(view, lowest_m)};
    leaves_.clear();
    wishes_.clear();
    tested_ = 0;
    by_depth_.resize(kMaxDepth + 2);
    for (TileNode& root : tree.roots()) visit(root);
    // A split forced on a coarser neighbour adds tiles of a depth already passed: go back to it.
    for (std::size_t depth = 0; depth < by_depth_.size();) {
        if (by_depth_[depth].empty()) {
            ++depth;
            continue;
        }
        TileNode& node = *by_depth_[depth].back();
        by_depth_[depth].pop_back();
        if (node.mark.split || !(too_coarse(node) || stays_split(node))) continue;
        const bool deeper = split(node);
        if (deeper) depth = 0;
    }
    std::erase_if(leaves_, [](const TileNode* node) { return node->mark.split; });
}

bool TileCut::sees(const TileBounds& bounds) const {
    const auto beyond = [&](const glm::dvec3& side) { return outside(bounds, view_.eye, side); };
    return std::none_of(view_.sides.begin(), view_.sides.end(), beyond) && !horizon_.hides(bounds);
}

double TileCut::error_px(const TileNode& node, int level, double error_m, double distance) const {
    const double px_a_metre = view_.kappa_px / std::max(distance, view_.near_m);
    const double shape_px = px_a_metre * error_m;
    const double curve_px = px_a_metre * sagitta_m(node.tile.depth, level) * seen_from_side(node.bounds);
    return std::max(shape_px, curve_px * tau_px_ / kHorizonPx);
}

/// Cosine of the elevation at which the eye sees a tile's middle, as measured there; 1 when the tile is too
/// near to have one.
double TileCut::seen_from_side(const TileBounds& bounds) const {
    const glm::dvec3 away = bounds.centre - view_.eye;
    const double distance = glm::length(away);
    if (distance < 4.0 * glm::length(bounds.half_m)) return 1.0;
    const double steepness = glm::dot(away, bounds.axes[2]) / distance;
    return std::sqrt(std::max(1.0 - steepness * steepness, 0.0));
}

bool TileCut::too_coarse(TileNode& node) const {
    const double px_a_metre = view_.kappa_px / std::max(node.mark.distance_m, view_.near_m);
    if (error_px(node, 0) > tau_px_ || px_a_metre * node.texel_to_refine_m > kMostPixelsATexel) return true;
    return excess_ && px_a_metre * (node.info.delta_m[0] + excess_(node)) > tau_px_;
}

bool TileCut::stays_split(TileNode& node) const {
    node.mark.kept = node.mark.was_split && keep_ && keep_(node);
    return node.mark.kept;
}

/// The leaf of the cut that covers a tile, or the tile's own node when the cut goes deeper there.
TileNode& TileCut::covering(TileId tile) const {
    TileNode* node = &tree_->roots()[ancestor(tile, 0).x];
    while (node->mark.split && node->tile.depth < tile.depth)
        node = &(*node->children)[static_cast<std::size_t>(quadrant(ancestor(tile, node->tile.depth + 1)))];
    return *node;
}

std::array<TileNode*, 2> TileCut::across(const TileNode& node, Edge edge) const {
    const auto beside = neighbour(node.tile, edge);
    if (!beside) return {nullptr, nullptr};
    TileNode& cover = covering(*beside);
    if (!cover.mark.split) {
        TileNode* leaf = cover.mark.visible ? &cover : nullptr;
        return {leaf, leaf};
    }
    std::array<TileNode*, 2> leaves{};
    const auto touching = children_at(opposite(edge));
    for (std::size_t half = 0; half < 2; ++half) {
        TileNode& leaf = (*cover.children)[touching[half]];
        leaves[half] = leaf.mark.visible && !leaf.mark.split ? &leaf : nullptr;
    }
    return leaves;
}

/// Enters a tile into the cut as a leaf.
void TileCut::visit(TileNode& node) {
    ++tested_;
    node.used_frame = frame_;
    const bool was_split = node.mark.frame + 1 == frame_ && node.mark.split;
    node.mark = {.frame = frame_,
                 .distance_m = distance_m(node.bounds, view_.eye),
                 .visible = sees(node.bounds),
                 .was_split = was_split};
    if (!node.mark.visible) return;
    by_depth_[node.tile.depth].push_back(&node);
    leaves_.push_back(&node);
}

/// Replaces a leaf by its children, after its coarser neighbours; false when blocks are missing for that.
bool TileCut::split(TileNode& node) {
    if (!have_children(node, error_px(node, 0))) return false;
    for (const Edge edge : kEdges) {
        const auto beside = neighbour(node.tile, edge);
        if (!beside) continue;
        keep_ready(*beside, error_px(node, 0));
        for (TileNode* cover = &covering(*beside);
             cover->mark.visible && cover->tile.depth < node.tile.depth && !cover->mark.split;
             cover = &covering(*beside)) {
            if (!split(*cover)) return false;
        }
    }
    node.mark.split = true;
    for (TileNode& child : *node.children) visit(child);
    return true;
}

/// Whether the four children can be drawn; wishes for those that are not loaded.
bool TileCut::have_children(TileNode& node, double priority) {
    const auto children = tree_->children(node);
    bool loaded = !children.empty();
    for (TileNode& child : children) {
        child.used_frame = frame_;
        if (child.block) continue;
        loaded = false;
        if (child.unreadable || child.wished_frame == frame_) continue;
        child.wished_frame = frame_;
        wishes_.push_back({&child, priority});
    }
    return loaded;
}

/// Sees that a tile could enter the cut at once: the blocks down to its own depth are loaded, and so is
/// whatever the splits on the way would force on their neighbours, and these on theirs. What is split keeps
/// its neighbours ready in this way though they are out of view: when the eye turns, a coarse neighbour that
/// cannot be split at once would hold back, tile by tile, everything finer beside it. Each tile is looked
/// after once a frame.
void TileCut::keep_ready(TileId tile, double priority) {
    TileNode* node = &tree_->roots()[ancestor(tile, 0).x];
    while (node->tile.depth < tile.depth) {
        if (node->ready_frame != frame_) {
            if (!have_children(*node, priority)) return;
            node->ready_frame = frame_;
            for (const Edge edge : kEdges) {
                if (const auto beside = neighbour(node->tile, edge)) keep_ready(*beside, priority);
            }
        }
        node = &(*node->children)[static_cast<std::size_t>(quadrant(ancestor(tile, node->tile.depth + 1)))];
    }
}

}  // namespace eyepoint::terrain
