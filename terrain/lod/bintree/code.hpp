/// Node codes of a right-triangle bintree: child, parent and neighbours by arithmetic, no pointers.
/// Source: He, Wang & Liu, An Improved Approach on Visualization of Large-Scale Terrain Surface (2007), rules
/// 1 to 6 (sections 2.3 and 3.2). docs/methods/bintree.md says where the paper is silent.
#pragma once

#include <bit>
#include <cstdint>
#include <optional>

#include "terrain/tiling/tile_id.hpp"

namespace eyepoint::terrain::bintree {

/// Nodes are numbered in the order of level traversal: 1 is the block's square, 2 and 3 its two triangles,
/// the roots; the children of n are 2n and 2n + 1. So a code is a 1, the root's bit, and a bit for every step
/// down: 0 left, 1 right.
using Code = std::uint32_t;
inline constexpr Code kRootA = 2, kRootB = 3;

/// 0 for the roots.
[[nodiscard]] constexpr int level(Code code) { return std::bit_width(code) - 2; }
/// Rule 1.
[[nodiscard]] constexpr Code left_child(Code code) { return code << 1; }
[[nodiscard]] constexpr Code right_child(Code code) { return (code << 1) + 1; }
/// Rule 2. Not of a root.
[[nodiscard]] constexpr Code parent(Code code) { return code >> 1; }
[[nodiscard]] constexpr bool is_left(Code code) { return (code & 1U) == 0; }

/// How a block's square is cut into its roots. Neighbouring blocks differ, so that the bintrees of all blocks
/// of one depth are parts of one mesh; and a child's diagonal runs to its parent's centre, so that a parent's
/// triangles of level 2 are its children's roots.
enum class Diagonal : std::uint8_t {
    Rising,  ///< south-west to north-east: A has its right angle in the south-east, B in the north-west
    Falling  ///< south-east to north-west: A has it in the north-east, B in the south-west
};
[[nodiscard]] constexpr Diagonal diagonal_of(TileId tile) {
    return ((tile.x + tile.y) & 1U) == 0 ? Diagonal::Rising : Diagonal::Falling;
}
[[nodiscard]] constexpr Diagonal other(Diagonal diagonal) {
    return diagonal == Diagonal::Rising ? Diagonal::Falling : Diagonal::Rising;
}

/// Which side of a triangle is shared: seen from the apex, the right angle, the left leg, the right leg, or
/// the base, the hypotenuse.
enum class Side : std::uint8_t { Left, Right, Base };

/// A triangle of the same level beside another: in the same block, or across one of its edges in the block of
/// the same depth there.
struct Neighbour {
    Code code = 0;
    std::optional<Edge> across;
    bool operator==(const Neighbour&) const = default;
};
/// Rule 3 and, where it leads out of the block, rule 6.
[[nodiscard]] Neighbour neighbour(Code code, Side side, Diagonal diagonal);

/// Corners in the block's cells from its south-west; apex, left, right are counterclockwise from above.
struct Post {
    int row = 0;
    int column = 0;
    bool operator==(const Post&) const = default;
};
struct Corners {
    Post apex, left, right;
};
/// cells: a side of the block, a power of two whose square is at least 2^level(code).
[[nodiscard]] Corners corners(Code code, Diagonal diagonal, int cells);
/// Middle of the base, where a split puts its vertex; the children need it to be a post.
[[nodiscard]] constexpr Post middle(const Corners& triangle) {
    return {(triangle.left.row + triangle.right.row) / 2, (triangle.left.column + triangle.right.column) / 2};
}

/// A triangle as a node of one of its block's four children, and back.
struct ChildNode {
    int quadrant = 0;  ///< as in terrain::child()
    Code code = 0;
    bool operator==(const ChildNode&) const = default;
};
/// Of a node of level 2 or more; two levels up in the child.
[[nodiscard]] ChildNode in_child(Code code, Diagonal diagonal);
/// diagonal: the parent block's.
[[nodiscard]] Code in_parent(ChildNode node, Diagonal diagonal);

}  // namespace eyepoint::terrain::bintree
