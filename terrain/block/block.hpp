/// A block unfolded for drawing: the 33 x 33 posts of a tile as vertices.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "terrain/block/cell_bounds.hpp"
#include "terrain/block/cell_boxes.hpp"
#include "terrain/block/relief.hpp"
#include "terrain/database/database.hpp"
#include "terrain/geodesy/position.hpp"

namespace eyepoint::terrain {

inline constexpr std::uint32_t kNoVertex = 0x7ff;

/// One vertex as the graphics card gets it: 32 bytes. What is painted on the ground is not a vertex's
/// (relief.hpp).
/// The ECEF position is the sum of two floats an axis (error under 1e-8 m at the Earth's surface). A post
/// shared by two tiles has the same bits in both, so that it lands on the same pixel from both.
struct BlockVertex {
    std::array<float, 3> high{};
    std::array<float, 3> low{};
    /// Place in the tile, kVertexPlaceUnits a side (rounded down, but never to the edge): x (east) in the low
    /// 16 bits, y (north) in the high.
    std::uint32_t place = 0;
    /// How a vertex of a nested mesh moves (database.hpp, NestedMesh): bits 0..10: its target in the same
    /// block or, where it stays, the same vertex in the parent's block (kNoVertex in a root); bits 11..17:
    /// the level at which it has gone, or kStaysField. And bits 18..31: MSL height, metres above
    /// kSurfaceFloorM.
    std::uint32_t rest = kStaysField << kGoneShift | kNoVertex;

    static constexpr std::uint32_t kStaysField = 0x7f;
    static constexpr int kGoneShift = 11;
    static constexpr int kHeightShift = 18;

    /// The target, or the same vertex in the parent's block.
    [[nodiscard]] std::uint16_t next() const { return static_cast<std::uint16_t>(rest & kNoVertex); }
    /// The level at which it has gone, or NestedMesh::kStays.
    [[nodiscard]] std::uint8_t gone_level() const {
        const std::uint32_t field = rest >> kGoneShift & kStaysField;
        return field == kStaysField ? NestedMesh::kStays : static_cast<std::uint8_t>(field);
    }
    [[nodiscard]] Ecef position() const {
        return {double{high[0]} + double{low[0]}, double{high[1]} + double{low[1]},
                double{high[2]} + double{low[2]}};
    }
    [[nodiscard]] double height_msl_m() const;
    /// The tile's edges that it is on: 1 west, 2 east, 4 south, 8 north.
    [[nodiscard]] std::uint8_t sides() const;
    /// gone_level: up to 63, or NestedMesh::kStays.
    void set_motion(std::uint32_t next, std::uint8_t gone_level);
};
static_assert(sizeof(BlockVertex) == 32);
static_assert(kBlockPosts * kBlockPosts <= kNoVertex);

inline constexpr std::uint32_t kVertexPlaceUnits = 32768;
inline constexpr double kSurfaceFloorM = -1500.0;
inline constexpr int kBlockVertices = kBlockPosts * kBlockPosts;

/// A position as the pair of floats whose sum it is.
struct SplitPosition {
    std::array<float, 3> high{};
    std::array<float, 3> low{};
};
[[nodiscard]] SplitPosition split(const Ecef& point);

/// What a block is unfolded to: a vertex for every post and the method's own index lists, or the tile's
/// nested mesh with index lists of its own.
enum class MeshKind : std::uint8_t { Grid, Nested };

/// Cells of a nested mesh, by which its triangles are sorted: kMeshCells a side, counted like posts.
inline constexpr int kMeshCells = 8;

/// The index list of one level of a nested mesh. Triangles of cell c: from cell_first[c] to cell_first[c +
/// 1], in indices of Block::indices. A triangle keeps the cell of the middle of the first level's triangle it
/// comes from.
struct NestedLevel {
    std::array<std::uint32_t, kMeshCells * kMeshCells + 1> cell_first{};
    std::uint64_t filled = 0;  ///< bit n: cell n has triangles
    [[nodiscard]] std::uint32_t first() const { return cell_first.front(); }
    [[nodiscard]] std::uint32_t count() const { return cell_first.back() - cell_first.front(); }
};

/// Immutable once made. Index of a vertex of a grid: row * kBlockPosts + column, row 0 in the south, column 0
/// in the west; of a nested mesh: NestedMesh's.
struct Block {
    BlockData data;
    std::vector<BlockVertex> vertices;   ///< at most kBlockVertices
    std::vector<ReliefPost> relief;      ///< of the 33 x 33 posts, in row order from the south-west
    std::vector<std::uint16_t> indices;  ///< of all levels; empty for a grid
    /// From first_level to last_level, and on while the cells' boxes and the parent's mesh say where vertices
    /// go: the last level's triangles without those that have slid shut by then. Empty for a grid.
    std::vector<NestedLevel> levels;
    std::uint8_t first_level = 0;
    std::uint8_t last_level = 0;
    /// The exact places of the last of a nested mesh's vertices, NestedMesh::fine_posts; empty for a grid.
    std::vector<NestedMesh::FinePost> fine_posts;
    CellBoxes cell_boxes;  ///< no levels for a grid
    /// Of a nested mesh as it is drawn; nullptr where they were not asked for.
    std::shared_ptr<const CellBounds> bounds;
    std::optional<ImageData> image;  ///< the tile's own picture, if it has one
    bool has_water = false;          ///< any post is water
    /// Of the last list there is: at least last_level.
    [[nodiscard]] int last_list_level() const { return first_level + static_cast<int>(levels.size()) - 1; }
    /// Memory it holds, bytes.
    [[nodiscard]] std::size_t bytes() const;
};

/// Unfolds a stored or interpolated tile. Positions by GeographicLib, in double, then split; normals from the
/// heights on both sides of a post (the apron on the tile's edges).
[[nodiscard]] std::shared_ptr<const Block> unfold(BlockData data, std::optional<ImageData> image);

/// Unfolds a nested mesh: vertices, and the index lists of all its levels. `parent` is the parent's block,
/// unfolded the same way; nullptr for a root. with_bounds: makes Block::bounds too, which horizon culling
/// needs.
[[nodiscard]] std::shared_ptr<const Block> unfold(BlockData data, const NodeInfo& info,
                                                  const NestedMesh& mesh, const Block* parent,
                                                  std::optional<ImageData> image, bool with_bounds = false);

}  // namespace eyepoint::terrain
