#include "terrain/lod/bintree/code.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace eyepoint::terrain::bintree {

namespace {

/// Across a root's leg lies the other half of the same pattern, the left leg on a right one or a right one on
/// a left: which root it is follows from the corner that the two right angles share.
Neighbour beside_root(Code root, Side side, Diagonal diagonal) {
    if (side == Side::Base) return {root == kRootA ? kRootB : kRootA, std::nullopt};
    const bool a = root == kRootA, left = side == Side::Left;
    if (diagonal == Diagonal::Rising) {
        if (a) return left ? Neighbour{kRootB, Edge::East} : Neighbour{kRootA, Edge::South};
        return left ? Neighbour{kRootA, Edge::West} : Neighbour{kRootB, Edge::North};
    }
    if (a) return left ? Neighbour{kRootA, Edge::North} : Neighbour{kRootB, Edge::East};
    return left ? Neighbour{kRootB, Edge::South} : Neighbour{kRootA, Edge::West};
}

Post between(Post a, Post b) { return {(a.row + b.row) / 2, (a.column + b.column) / 2}; }

/// The eight nodes of level 2 as children's roots, by code - 8.
using Level2 = std::array<ChildNode, 8>;
constexpr int kSouthWest = 0, kSouthEast = 1, kNorthWest = 2, kNorthEast = 3;
constexpr Level2 kRising{{{kSouthEast, kRootA},
                          {kNorthEast, kRootA},
                          {kSouthWest, kRootA},
                          {kSouthEast, kRootB},
                          {kNorthWest, kRootB},
                          {kSouthWest, kRootB},
                          {kNorthEast, kRootB},
                          {kNorthWest, kRootA}}};
constexpr Level2 kFalling{{{kNorthEast, kRootB},
                           {kNorthWest, kRootA},
                           {kSouthEast, kRootA},
                           {kNorthEast, kRootA},
                           {kSouthWest, kRootA},
                           {kSouthEast, kRootB},
                           {kNorthWest, kRootB},
                           {kSouthWest, kRootB}}};
constexpr Code kFirstOfLevel2 = 8;

const Level2& level2(Diagonal diagonal) { return diagonal == Diagonal::Rising ? kRising : kFalling; }

}  // namespace

/// Rule 3 for the left child; "for the right child, the similar process" is its mirror image.
Neighbour neighbour(Code code, Side side, Diagonal diagonal) {
    if (level(code) == 0) return beside_root(code, side, diagonal);
    const bool left = is_left(code);
    const Side to_sibling = left ? Side::Left : Side::Right;
    if (side == to_sibling) return {code ^ 1U, std::nullopt};
    const Side of_parent = side == Side::Base ? to_sibling : Side::Base;
    Neighbour found = neighbour(parent(code), of_parent, diagonal);
    found.code = left ? right_child(found.code) : left_child(found.code);
    return found;
}

Corners corners(Code code, Diagonal diagonal, int cells) {
    const Post south_west{0, 0}, south_east{0, cells}, north_west{cells, 0}, north_east{cells, cells};
    const int steps = level(code);
    const bool a = (code >> steps) == kRootA;
    Corners triangle{};
    if (diagonal == Diagonal::Rising) {
        triangle =
            a ? Corners{south_east, north_east, south_west} : Corners{north_west, south_west, north_east};
    } else {
        triangle =
            a ? Corners{north_east, north_west, south_east} : Corners{south_west, south_east, north_west};
    }
    for (int bit = steps - 1; bit >= 0; --bit) {
        const Post split = between(triangle.left, triangle.right);
        triangle = ((code >> bit) & 1U) == 0 ? Corners{split, triangle.apex, triangle.left}
                                             : Corners{split, triangle.right, triangle.apex};
    }
    return triangle;
}

ChildNode in_child(Code code, Diagonal diagonal) {
    const int below = level(code) - 2;
    ChildNode node = level2(diagonal)[(code >> below) - kFirstOfLevel2];
    node.code = (node.code << below) | (code & ((Code{1} << below) - 1));
    return node;
}

Code in_parent(ChildNode node, Diagonal diagonal) {
    const int below = level(node.code);
    const ChildNode root{node.quadrant, node.code >> below};
    const Level2& roots = level2(diagonal);
    const auto at = static_cast<Code>(std::find(roots.begin(), roots.end(), root) - roots.begin());
    return ((kFirstOfLevel2 + at) << below) | (node.code & ((Code{1} << below) - 1));
}

}  // namespace eyepoint::terrain::bintree
