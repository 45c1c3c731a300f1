/// The interface every level-of-detail method stands behind: a view in, the meshes to draw out.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

#include "terrain/geodesy/position.hpp"
#include "terrain/lod/hyperblock/hyperblock_options.hpp"
#include "terrain/lod/selective/selective_options.hpp"
#include "terrain/lod/tile/tile_options.hpp"
#include "terrain/pager/pager.hpp"

namespace eyepoint::terrain {

/// What a method keeps of a block it keeps for so many frames after the block's last use, and drops in every
/// so-manieth.
inline constexpr std::uint64_t kHeldFrames = 120, kDropEvery = 32;

/// What a method must know of a view.
struct LodView {
    Ecef eye{0.0};
    /// Inward unit normals of the view volume's four sides (left, right, bottom, top), all through the eye.
    std::array<glm::dvec3, 4> sides{};
    double kappa_px = 1.0;  ///< pixels per unit of metres over metres at the picture's centre
    double tau_px = 1.0;    ///< tolerance
    double slack_px = 0.0;  ///< a choice once made may stand until its error is tau + slack
    double near_m = 0.5;    ///< nothing nearer is drawn
    /// When and in which drawn frame, for what is animated; neither goes back. Several selections may be of
    /// one.
    double time_s = 0.0;
    std::uint64_t drawn_frame = 0;
};

/// Triangles of a mesh: part of an index list (index_list()). Indices name vertices of one block.
struct IndexRange {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
};
/// A gap between runs of cells that are drawn is drawn too if it has fewer indices: a draw more costs as
/// much.
inline constexpr std::uint32_t kGapIndices = 3 * 12;

/// The index list that a method has made for one block and makes anew when it wants other triangles.
/// Unchanged lists are not sent to the graphics card again.
struct BlockMesh {
    std::vector<std::uint16_t> indices;
    std::uint64_t version = 0;  ///< another one whenever the indices are others, over all lists of the method
};

/// Vertices on an edge of a nested mesh are drawn as if the level asked for were at least so high: what is
/// beyond the edge has no finer ones because it is not loaded. By edge (kEdges) and half (the one nearer the
/// edge's start first).
using EdgeFloors = std::array<std::uint8_t, 8>;

/// How the vertices of a tile of a grid slide from one level to the next (terrain/lod/tile/tile_slide.hpp).
/// A block is divided into LodMethod::sliding_parts() tiles a side, row by row from the south-west.
struct TileSlide {
    std::uint8_t part = 0;
    std::uint8_t level = 0;     ///< that is drawn: every 2^level-th post
    std::uint8_t slid = 0;      ///< inside, towards level + 1, in steps of 1 / kSlideSteps
    std::uint8_t stitched = 0;  ///< half edges drawn with the posts of level + 1: a bit each
    /// What vertices on the edges have slid towards the next level of the half edge; by edge (kEdges) and
    /// half.
    std::array<std::uint8_t, 8> border{};
    bool operator==(const TileSlide&) const = default;
};
inline constexpr int kSlideSteps = 128;

/// A block may be drawn in several parts; all of a block's draws have the same floors.
struct BlockDraw {
    const TileNode* node = nullptr;  ///< its block is loaded
    IndexRange indices;
    std::uint8_t level = 0;  ///< of the mesh, for show and statistics
    EdgeFloors floors{};
    /// The list that the indices are of, where the method makes its own; good as long as the selection.
    const BlockMesh* mesh = nullptr;
    TileSlide slide{};  ///< where LodMethod::sliding_parts() is not 0
};

/// BlockDraw::level of a list made for a block, by its triangles: 0 with all posts, 1 more for every halving,
/// so that the fewer triangles, the higher the level, as with other methods.
[[nodiscard]] inline std::uint8_t shown_level(std::uint32_t triangles) {
    constexpr auto kAllPosts = static_cast<unsigned>(2 * kBlockCells * kBlockCells);
    return static_cast<std::uint8_t>(std::bit_width(kAllPosts) - std::bit_width(triangles));
}

/// What to draw, near to far, and what to load. Meshes of neighbouring draws meet without cracks.
struct Selection {
    std::vector<BlockDraw> draws;
    std::vector<BlockRequest> wishes;
    std::uint64_t triangles = 0;
    std::uint32_t blocks_tested = 0;     ///< candidates looked at
    std::uint32_t blocks_reused = 0;     ///< of them: the choice of an earlier frame stood
    std::uint32_t blocks_chosen = 0;     ///< of them: chosen anew; the rest was out of view
    std::uint64_t triangles_hidden = 0;  ///< left out because nearer terrain hides them
};

/// The list that a draw's range is of: one made for the block, else the method's, else the block's own.
[[nodiscard]] inline std::span<const std::uint16_t> index_list(const BlockDraw& draw,
                                                               std::span<const std::uint16_t> of_method) {
    if (draw.mesh != nullptr) return draw.mesh->indices;
    return of_method.empty() ? std::span<const std::uint16_t>{draw.node->block->indices} : of_method;
}
[[nodiscard]] inline std::span<const std::uint16_t> indices_of(const BlockDraw& draw,
                                                               std::span<const std::uint16_t> of_method) {
    return index_list(draw, of_method).subspan(draw.indices.first, draw.indices.count);
}

/// Thread use: one thread (the frame's).
class LodMethod {
  public:
    virtual ~LodMethod() = default;
    [[nodiscard]] virtual std::string_view name() const = 0;
    /// What blocks must be unfolded to. Nested: selections refer to the blocks' own index lists, and vertices
    /// move as terrain/lod/nested_motion.hpp says, at the tolerance tau + slack.
    [[nodiscard]] virtual MeshKind mesh_kind() const = 0;
    /// The index list that all draws refer to, constant over the method's life. Empty: each draw has a list
    /// of its block (index_list()).
    [[nodiscard]] virtual std::span<const std::uint16_t> indices() const = 0;
    /// Tiles a side that a grid's block is divided into, whose vertices slide by BlockDraw::slide; 0: the
    /// vertices of grids stand. Constant.
    [[nodiscard]] virtual int sliding_parts() const { return 0; }
    /// The reference is good until the next call. The frame number grows by one a call; the tree is the same
    /// one in every call.
    [[nodiscard]] virtual const Selection& select(const LodView& view, TileTree& tree,
                                                  std::uint64_t frame) = 0;
};

/// Names that make_lod_method knows.
[[nodiscard]] std::span<const std::string_view> lod_method_names();
/// What only some methods can; the others go without.
struct LodMethodOptions {
    /// Leave out what nearer terrain hides; nested, and it takes blocks with bounds
    /// (PagerOptions::cell_bounds).
    bool cull = false;
    /// Triangles drawn at most, the tolerance being exceeded where they do not suffice; bintree. 0: no limit.
    std::uint32_t triangle_budget = 0;
    selective::Options selective{};
    tiles::Options tile{};
    hyperblock::Options hyperblock{};
};
/// nullptr for an unknown name.
[[nodiscard]] std::unique_ptr<LodMethod> make_lod_method(std::string_view name,
                                                         const LodMethodOptions& options = {});

}  // namespace eyepoint::terrain
