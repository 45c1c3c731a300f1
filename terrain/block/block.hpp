/// A block unfolded for drawing: the 33 x 33 posts of a tile as vertices.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "terrain/database/database.hpp"
#include "terrain/geodesy/position.hpp"

namespace eyepoint::terrain {

/// One post as the graphics card gets it: 32 bytes.
/// The ECEF position is the sum of two floats an axis (error under 1e-8 m at the Earth's surface). A post
/// shared by two tiles has the same bits in both, so that it lands on the same pixel from both.
struct BlockVertex {
    std::array<float, 3> high{};
    std::array<float, 3> low{};
    /// Surface normal in ECEF, signed normalised 10:10:10:2, x in the low bits.
    std::uint32_t normal = 0;
    /// Low 16 bits: MSL height in quarters of a metre above kSurfaceFloorM; bit 16: water.
    std::uint32_t surface = 0;
};
static_assert(sizeof(BlockVertex) == 32);

inline constexpr double kSurfaceFloorM = -1500.0;
inline constexpr double kSurfaceStepM = 0.25;
inline constexpr int kBlockVertices = kBlockPosts * kBlockPosts;

/// A position as the pair of floats whose sum it is.
struct SplitPosition {
    std::array<float, 3> high{};
    std::array<float, 3> low{};
};
[[nodiscard]] SplitPosition split(const Ecef& point);

/// Immutable once made. Index of a vertex: row * kBlockPosts + column, row 0 in the south, column 0 in the
/// west.
struct Block {
    BlockData data;
    std::vector<BlockVertex> vertices;
    std::optional<ImageData> image;  ///< the tile's own picture, if it has one
    bool has_water = false;          ///< any post is water
    /// Memory it holds, bytes.
    [[nodiscard]] std::size_t bytes() const;
};

/// Unfolds a stored or interpolated tile. Positions by GeographicLib, in double, then split; normals from the
/// heights on both sides of a post (the apron on the tile's edges).
[[nodiscard]] std::shared_ptr<const Block> unfold(BlockData data, std::optional<ImageData> image);

}  // namespace eyepoint::terrain
