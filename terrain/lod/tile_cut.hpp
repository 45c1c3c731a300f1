/// Which tiles to draw for a view: the leaves of a cut through the quadtree, for methods that draw grids.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "terrain/lod/lod_method.hpp"
#include "terrain/tiling/tile_bounds.hpp"

namespace eyepoint::terrain {

/// From the roots down, a visible tile is split when its finest level is too coarse for the view:
/// kappa * delta_0 / D > tau (delta_0 plus what the method's triangulation adds), or when its picture's
/// texels cover more than two pixels and there are finer pictures below. A split needs the four children
/// loaded (else they are wished for and the tile is drawn in their place), and no edge neighbour that is
/// drawn and less deep (else that is split first): so neighbours in the cut differ by one depth at most.
/// Tiles outside the view or hidden by the curve of the Earth are not drawn and set no conditions: an edge
/// shared with them is not seen.
/// Uses TileNode::mark. Thread use: the frame's.
class TileCut {
  public:
    /// What a tile's own triangulation of all its posts errs by beyond delta_0, metres.
    using Excess = std::function<double(TileNode&)>;
    /// Whether a tile that would do, and whose children are loaded, stays split (LodMark::kept).
    using Keep = std::function<bool(const TileNode&)>;

    TileCut() = default;
    /// excess: of a tile whose block is loaded. keep: of a tile that the update before has split; its
    /// children's marks are still those of that update.
    explicit TileCut(Excess excess, Keep keep = {}) : excess_(std::move(excess)), keep_(std::move(keep)) {}

    /// tau_px: what a tile's finest level may err by. The tree must outlive the next update.
    void update(const LodView& view, double tau_px, TileTree& tree, std::uint64_t frame);

    /// Of the last update: the visible leaves, their blocks loaded, in no particular order.
    [[nodiscard]] std::span<TileNode* const> leaves() const { return leaves_; }
    /// Of the last update: children that a split lacked.
    [[nodiscard]] const std::vector<BlockRequest>& wishes() const { return wishes_; }
    /// Of the last update: tiles looked at.
    [[nodiscard]] std::uint32_t tested() const { return tested_; }

    /// Screen error of a level (every 2^l-th post) of a tile in the cut, pixels: of its shape, or of the
    /// curve of the Earth alone, whichever asks for more. The curve is held to kHorizonPx whatever tau is, as
    /// far as it is seen from the side: the horizon is the one line in the picture that is known exactly.
    [[nodiscard]] double error_px(const TileNode& node, int level) const {
        return error_px(node, level, double{node.info.delta_m[static_cast<std::size_t>(level)]},
                        node.mark.distance_m);
    }
    /// The same of a part of the tile, so far from the eye and with an error of its own.
    [[nodiscard]] double error_px(const TileNode& node, int level, double error_m, double distance) const;
    /// Whether a tile in the cut, drawn with all its posts, is too coarse in shape, or its picture too coarse
    /// where there is a finer one.
    [[nodiscard]] bool too_coarse(TileNode& node) const;
    /// The visible leaves across a leaf's edge: one at most as deep as the tile, or the two of the next
    /// depth, in the order of the edge's halves; absent ones are nullptr. When one leaf covers the whole edge
    /// it is in both places.
    [[nodiscard]] std::array<TileNode*, 2> across(const TileNode& node, Edge edge) const;

  private:
    [[nodiscard]] bool sees(const TileBounds& bounds) const;
    [[nodiscard]] double seen_from_side(const TileBounds& bounds) const;
    [[nodiscard]] bool stays_split(TileNode& node) const;
    [[nodiscard]] TileNode& covering(TileId tile) const;
    void visit(TileNode& node);
    [[nodiscard]] bool split(TileNode& node);
    [[nodiscard]] bool have_children(TileNode& node, double priority);
    void keep_ready(TileId tile, double priority);

    Excess excess_;
    Keep keep_;
    LodView view_;
    double tau_px_ = 1.0;
    TileTree* tree_ = nullptr;
    std::uint64_t frame_ = 0;
    HorizonOccluder horizon_{Ecef{0.0}, 0.0};
    std::vector<std::vector<TileNode*>> by_depth_;  ///< tiles to visit, coarsest first
    std::vector<TileNode*> leaves_;
    std::vector<BlockRequest> wishes_;
    std::uint32_t tested_ = 0;
};

/// Orders what a method keeps of the leaves of a cut near to far, and numbers the leaves so (LodMark::draw).
/// Kept: has a pointer to its TileNode, `node`.
template <class Kept>
void number_near_to_far(std::vector<Kept*>& drawn) {
    std::sort(drawn.begin(), drawn.end(), [](const Kept* a, const Kept* b) {
        return a->node->mark.distance_m < b->node->mark.distance_m;
    });
    for (std::size_t i = 0; i < drawn.size(); ++i) drawn[i]->node->mark.draw = static_cast<std::uint32_t>(i);
}

/// How far, in pixels, the drawn horizon of a bare Earth may lie from the true one, for the mesh's part.
inline constexpr double kHorizonPx = 0.45;

}  // namespace eyepoint::terrain
