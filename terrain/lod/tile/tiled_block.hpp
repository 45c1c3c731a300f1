/// What the method of Larsen & Christensen knows of a block: its tiles, what each level of them errs by, and
/// what they are drawn as.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "terrain/lod/tile/tile_mesh.hpp"
#include "terrain/lod/tile/tile_slide.hpp"
#include "terrain/pager/tile_tree.hpp"
#include "terrain/tiling/tile_bounds.hpp"

namespace eyepoint::terrain::tiles {

/// Metres that each level of a tile errs by, at any post of the full-resolution surface below it, along the
/// vertical: what the block errs by with all its posts (unseen_m), the greatest height difference at these,
/// and the Earth's arc over a cell.
[[nodiscard]] std::array<float, kMostLevels> level_errors_m(const BlockData& data, float unseen_m,
                                                            const Division& division, int part);

/// One of the paper's tiles.
struct Tile {
    const TileNode* node = nullptr;  ///< of its block
    int part = 0;                    ///< of the block
    /// Where it is, as a tile of the geographic tiling: the block's, or one below that.
    TileId place;
    TileBounds bounds;
    std::array<float, kMostLevels> error_m{};

    Fineness drawn;
    double slid = 0.0;  ///< drawn.slid, exactly, 0..1
    int wanted = 0;     ///< resolution that the view asks for

    // Of the frame in hand.
    double distance_m = 0.0;
    double error_px = 0.0;  ///< of `drawn.resolution`
    bool fresh = false;     ///< was not drawn in the frame before
    bool held = false;      ///< its block's parent would do: it is drawn so that that can take over
    /// Tiles that are drawn across the edges, by edge and half; nullptr where none is.
    std::array<Tile*, 8> beside{};
    IndexRange mesh{};  ///< drawn last

    [[nodiscard]] int level_of(int resolution) const {
        return static_cast<int>(node->tile.depth) + kBlockHalvings - resolution;
    }
    [[nodiscard]] int resolution_of(int level) const { return level_of(level); }
    void set(int resolution, double share) {
        slid = share;
        drawn = {resolution, static_cast<int>(share * kSlideSteps + 0.5)};
    }

    /// log2 of the posts a side of the Earth's half circle: a block's depth, plus the halvings in it.
    static constexpr int kBlockHalvings = 5;
};

struct TiledBlock {
    static constexpr std::uint64_t kNever = ~std::uint64_t{0} / 2;

    TileNode* node = nullptr;
    /// What the block errs by with all its posts, beyond delta of its finest level: metres.
    double excess_m = 0.0;
    std::uint64_t touched_frame = 0;     ///< last frame that asked for it
    std::uint64_t drawn_frame = kNever;  ///< last frame that drew it
    bool starved = false;                ///< then: too coarse for the view, all its posts drawn
    std::vector<Tile> tiles;
};
/// node: its block is loaded.
[[nodiscard]] TiledBlock tiled(TileNode& node, const Division& division);

}  // namespace eyepoint::terrain::tiles
