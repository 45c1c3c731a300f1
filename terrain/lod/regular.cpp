#include "terrain/lod/regular.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <glm/geometric.hpp>

#include "terrain/geodesy/earth.hpp"
#include "terrain/lod/planet_horizon.hpp"
#include "terrain/tiling/tile_edges.hpp"

namespace eyepoint::terrain {

namespace {

/// log2 of the posts a side of the Earth's half circle: a tile's depth, plus the five halvings in its block.
constexpr int kBlockHalvings = 5;

/// A picture's texel may cover so many pixels before a finer picture is wanted.
constexpr double kMostPixelsATexel = 2.0;

/// How far, in pixels, the drawn horizon of a bare Earth may lie from the true one, for the mesh's part.
constexpr double kHorizonPx = 0.45;

/// Height of the Earth's arc over the diagonal of a cell of a level, at the equator, where it is greatest,
/// metres.
double sagitta_m(std::uint32_t depth, int level) {
    constexpr double kRadians = 3.14159265358979323846 / 180.0;
    const double chord_m = post_spacing_deg(depth) * (1 << level) * kRadians * kEquatorialRadiusM;
    return 2.0 * chord_m * chord_m / (8.0 * kEquatorialRadiusM);
}

int resolution(const TileNode& node) {
    return static_cast<int>(node.tile.depth) + kBlockHalvings - node.mark.level;
}

}  // namespace

struct RegularLod::Frame {
    const LodView& view;
    TileTree& tree;
    std::uint64_t number;
    HorizonOccluder horizon;

    [[nodiscard]] bool in_cut(const TileNode& node) const { return node.mark.frame == number; }

    [[nodiscard]] bool sees(const TileBounds& bounds) const {
        const auto beyond = [&](const glm::dvec3& side) { return outside(bounds, view.eye, side); };
        return std::none_of(view.sides.begin(), view.sides.end(), beyond) && !horizon.hides(bounds);
    }

    /// Screen error of a level of this tile, pixels: of its shape, or of the curve of the Earth alone,
    /// whichever asks for more. The curve is held to kHorizonPx whatever tau is, as far as it is seen from
    /// the side: the horizon is the one line in the picture that is known exactly.
    [[nodiscard]] double error_px(const TileNode& node, int level) const {
        const double px_a_metre = view.kappa_px / std::max(node.mark.distance_m, view.near_m);
        const double shape_px = px_a_metre * node.info.delta_m[static_cast<std::size_t>(level)];
        const double curve_px = px_a_metre * sagitta_m(node.tile.depth, level) * seen_from_side(node.bounds);
        return std::max(shape_px, curve_px * view.tau_px / kHorizonPx);
    }

    /// Cosine of the elevation at which the eye sees a tile's middle, as measured there; 1 when the tile is
    /// too near to have one.
    [[nodiscard]] double seen_from_side(const TileBounds& bounds) const {
        const glm::dvec3 away = bounds.centre - view.eye;
        const double distance = glm::length(away);
        if (distance < 4.0 * glm::length(bounds.half_m)) return 1.0;
        const double steepness = glm::dot(away, bounds.axes[2]) / distance;
        return std::sqrt(std::max(1.0 - steepness * steepness, 0.0));
    }

    /// Too coarse in shape, or its picture too coarse where there is a finer one.
    [[nodiscard]] bool too_coarse(const TileNode& node) const {
        const double texel_px =
            view.kappa_px * node.texel_to_refine_m / std::max(node.mark.distance_m, view.near_m);
        return error_px(node, 0) > view.tau_px || texel_px > kMostPixelsATexel;
    }

    /// The leaf of the cut that covers a tile, or the tile's own node when the cut goes deeper there.
    [[nodiscard]] TileNode& covering(TileId tile) const {
        TileNode* node = &tree.roots()[ancestor(tile, 0).x];
        while (node->mark.split && node->tile.depth < tile.depth) {
            node =
                &(*node->children)[static_cast<std::size_t>(quadrant(ancestor(tile, node->tile.depth + 1)))];
        }
        return *node;
    }

    /// The visible leaves across an edge: one at most as deep as the tile, or the two of the next depth, in
    /// the order of the edge's halves; absent ones are nullptr. When one leaf covers the whole edge it is in
    /// both places.
    [[nodiscard]] std::array<TileNode*, 2> across(const TileNode& node, Edge edge) const {
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
};

const Selection& RegularLod::select(const LodView& view, TileTree& tree, std::uint64_t frame_number) {
    const double lowest_m = tree.lowest_height_m();
    const HorizonOccluder horizon{view.eye, lowest_m - mesh_below_surface_m(view, lowest_m)};
    Frame frame{view, tree, frame_number, horizon};
    selection_.draws.clear();
    selection_.wishes.clear();
    selection_.triangles = 0;
    selection_.blocks_tested = 0;
    leaves_.clear();
    cut(frame);
    choose_levels(frame);
    balance(frame);
    emit(frame);
    return selection_;
}

void RegularLod::cut(Frame& frame) {
    by_depth_.resize(kMaxDepth + 2);
    for (TileNode& root : frame.tree.roots()) visit(frame, root);
    // A split forced on a coarser neighbour adds tiles of a depth already passed: go back to it.
    for (std::size_t depth = 0; depth < by_depth_.size();) {
        if (by_depth_[depth].empty()) {
            ++depth;
            continue;
        }
        TileNode& node = *by_depth_[depth].back();
        by_depth_[depth].pop_back();
        if (node.mark.split || !frame.too_coarse(node)) continue;
        const bool deeper = split(frame, node);
        if (deeper) depth = 0;
    }
}

/// Enters a tile into the cut as a leaf.
void RegularLod::visit(Frame& frame, TileNode& node) {
    ++selection_.blocks_tested;
    node.used_frame = frame.number;
    node.mark = {frame.number, distance_m(node.bounds, frame.view.eye), 0, false, frame.sees(node.bounds)};
    if (!node.mark.visible) return;
    by_depth_[node.tile.depth].push_back(&node);
    leaves_.push_back(&node);
}

/// Replaces a leaf by its children, after its coarser neighbours; false when blocks are missing for that.
bool RegularLod::split(Frame& frame, TileNode& node) {
    if (!have_children(frame, node, frame.error_px(node, 0))) return false;
    for (const Edge edge : kEdges) {
        const auto beside = neighbour(node.tile, edge);
        if (!beside) continue;
        keep_ready(frame, *beside, frame.error_px(node, 0));
        for (TileNode* cover = &frame.covering(*beside);
             cover->mark.visible && cover->tile.depth < node.tile.depth && !cover->mark.split;
             cover = &frame.covering(*beside)) {
            if (!split(frame, *cover)) return false;
        }
    }
    node.mark.split = true;
    for (TileNode& child : *node.children) visit(frame, child);
    return true;
}

/// Whether the four children can be drawn; wishes for those that are not loaded.
bool RegularLod::have_children(const Frame& frame, TileNode& node, double priority) {
    const auto children = frame.tree.children(node);
    bool loaded = !children.empty();
    for (TileNode& child : children) {
        child.used_frame = frame.number;
        if (child.block) continue;
        loaded = false;
        if (child.unreadable || child.wished_frame == frame.number) continue;
        child.wished_frame = frame.number;
        selection_.wishes.push_back({&child, priority});
    }
    return loaded;
}

/// Sees that a tile could enter the cut at once: the blocks down to its own depth are loaded, and so is
/// whatever the splits on the way would force on their neighbours, and these on theirs. What is split keeps
/// its neighbours ready in this way though they are out of view: when the eye turns, a coarse neighbour that
/// cannot be split at once would hold back, tile by tile, everything finer beside it. Each tile is looked
/// after once a frame.
void RegularLod::keep_ready(const Frame& frame, TileId tile, double priority) {
    TileNode* node = &frame.tree.roots()[ancestor(tile, 0).x];
    while (node->tile.depth < tile.depth) {
        if (node->ready_frame != frame.number) {
            if (!have_children(frame, *node, priority)) return;
            node->ready_frame = frame.number;
            for (const Edge edge : kEdges) {
                if (const auto beside = neighbour(node->tile, edge)) keep_ready(frame, *beside, priority);
            }
        }
        node = &(*node->children)[static_cast<std::size_t>(quadrant(ancestor(tile, node->tile.depth + 1)))];
    }
}

void RegularLod::choose_levels(Frame& frame) {
    std::erase_if(leaves_, [](const TileNode* node) { return node->mark.split; });
    for (TileNode* node : leaves_) {
        int level = kRegularLevels - 1;
        while (level > 0 && frame.error_px(*node, level) > frame.view.tau_px) --level;
        node->mark.level = static_cast<std::int8_t>(level);
    }
}

void RegularLod::balance(Frame& frame) {
    by_resolution_.resize(kMaxDepth + kBlockHalvings + 1);
    for (TileNode* node : leaves_)
        by_resolution_[static_cast<std::size_t>(resolution(*node))].push_back(node);
    for (auto at = static_cast<int>(by_resolution_.size()) - 1; at >= 0; --at) {
        auto& bucket = by_resolution_[static_cast<std::size_t>(at)];
        for (const TileNode* node : bucket) {
            if (resolution(*node) != at) continue;  // raised since it was put here
            for (const Edge edge : kEdges) {
                for (TileNode* beside : frame.across(*node, edge)) {
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

void RegularLod::emit(Frame& frame) {
    std::sort(leaves_.begin(), leaves_.end(),
              [](const TileNode* a, const TileNode* b) { return a->mark.distance_m < b->mark.distance_m; });
    for (const TileNode* node : leaves_) {
        unsigned thinned = 0;
        for (std::size_t edge = 0; edge < kEdges.size(); ++edge) {
            const auto beside = frame.across(*node, kEdges[edge]);
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
