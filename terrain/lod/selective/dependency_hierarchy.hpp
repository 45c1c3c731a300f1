/// The two hierarchies of a block of (2^n + 1)^2 posts, n = 5: which vertex stands on which, and which
/// triangles a vertex makes. Source: Ueng & Chuang, section 3.2. The same for all blocks.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "terrain/block/block.hpp"

namespace eyepoint::terrain::selective {

/// Level 0 is the block's four corners and two triangles; levels 1 to 2n each add the middles of the bases of
/// the triangles of the level before.
inline constexpr int kLevels = 11;
static_assert(1 << ((kLevels - 1) / 2) == kBlockCells);

inline constexpr std::uint8_t kInside = 4;

/// A vertex by its place in the bottom-up traversal: the finest level first.
using Rank = std::uint16_t;
inline constexpr Rank kNoRank = 0xffff;
/// All but the corners, which are in every mesh.
inline constexpr std::size_t kRanks = kBlockVertices - 4;

/// A node of the triangle tree, counterclockwise from above.
struct TreeTriangle {
    std::array<std::uint16_t, 3> vertices{};  ///< apex, left, right: of Block::vertices
    Rank middle = kNoRank;                    ///< of its base, whose selection splits it; none: finest level
};

struct HierarchyVertex {
    std::uint16_t post = 0;                         ///< of Block::vertices
    std::uint8_t level = 0;                         ///< 1..kLevels - 1
    std::array<Rank, 2> parents{kNoRank, kNoRank};  ///< mother and father; one on the border, none of corners
    /// The triangles it makes: those it is the apex of. Four, or two on the border.
    std::array<TreeTriangle, 4> triangles{};
    std::uint8_t triangle_count = 0;
    std::uint8_t edge = kInside;   ///< that it is on, in kEdges
    std::uint32_t border_bit = 0;  ///< 1 << its place along that edge
};

class DependencyHierarchy {
  public:
    /// Made on first use.
    [[nodiscard]] static const DependencyHierarchy& of_block();

    /// By rank.
    [[nodiscard]] std::span<const HierarchyVertex, kRanks> vertices() const {
        return std::span<const HierarchyVertex, kRanks>{vertices_};
    }
    /// The triangles of level 0.
    [[nodiscard]] const std::array<TreeTriangle, 2>& roots() const { return roots_; }
    /// kNoRank of a corner.
    [[nodiscard]] Rank rank_of(std::uint16_t post) const { return ranks_[post]; }

  private:
    DependencyHierarchy();
    void grow(const TreeTriangle& triangle, int level);
    void sort_bottom_up();

    std::vector<HierarchyVertex> vertices_;
    std::array<TreeTriangle, 2> roots_{};
    std::array<Rank, kBlockVertices> ranks_{};
};

/// Middle of a triangle's base: posts are numbered row by row, so it is the mean of two numbers.
[[nodiscard]] constexpr std::uint16_t middle_post(const TreeTriangle& triangle) {
    return static_cast<std::uint16_t>((triangle.vertices[1] + triangle.vertices[2]) / 2);
}

}  // namespace eyepoint::terrain::selective
