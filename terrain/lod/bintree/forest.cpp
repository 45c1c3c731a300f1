#include "terrain/lod/bintree/forest.hpp"

#include "terrain/tiling/tile_edges.hpp"

namespace eyepoint::terrain::bintree {

BlockNumber Forest::add(TileId tile) {
    if (free_.empty()) {
        free_.push_back(static_cast<BlockNumber>(trees_.size()));
        trees_.emplace_back();
    }
    const BlockNumber number = free_.back();
    free_.pop_back();
    trees_[number] = Tree{.tile = tile, .diagonal = diagonal_of(tile), .across = {}, .split = {}};
    return number;
}

void Forest::remove(BlockNumber block) { free_.push_back(block); }

void Forest::set(BlockNumber block, Code code, bool split) {
    Tree& tree = trees_[block];
    tree.changed = true;
    if (split) {
        tree.split.insert(code);
    } else {
        tree.split.erase(code);
    }
}

/// Rules 3 and 6; between depths the same triangle has a code in the parent and one in the child.
Forest::Partner Forest::beside(BlockNumber block, Code code, Side side) const {
    const Tree& tree = trees_[block];
    const Neighbour found = neighbour(code, side, tree.diagonal);
    if (!found.across) return {Partner::Kind::Node, block, found.code};
    const Across& across = tree.across[static_cast<std::size_t>(*found.across)];
    switch (across.kind) {
        case Across::Kind::Nothing:
            break;
        case Across::Kind::Same:
            return {Partner::Kind::Node, across.blocks[0], found.code};
        case Across::Kind::Coarser: {
            const TileId beside = *terrain::neighbour(tree.tile, *found.across);
            return {Partner::Kind::Node, across.blocks[0],
                    in_parent({quadrant(beside), found.code}, diagonal_of(terrain::parent(beside)))};
        }
        case Across::Kind::Finer: {
            if (level(found.code) < 2) return {Partner::Kind::Split};
            const ChildNode child = in_child(found.code, other(tree.diagonal));
            const auto touching = children_at(opposite(*found.across));
            const std::size_t half = touching[0] == static_cast<std::size_t>(child.quadrant) ? 0 : 1;
            if (across.blocks[half] == kNoBlock) break;
            return {Partner::Kind::Node, across.blocks[half], child.code};
        }
    }
    return {};
}

/// The paper's refinement: first the base neighbour, if it is coarser, then both.
bool Forest::split(BlockNumber block, Code code) {
    if (code >= kSplitCodesEnd) return false;
    if (is_split(block, code)) return true;
    const Partner base = partner(block, code);
    const bool shared = base.kind == Partner::Kind::Node;
    if (shared && base.code >= kSplitCodesEnd) return false;
    if (level(code) > 0 && !split(block, parent(code))) return false;
    if (shared && level(base.code) > 0 && !split(base.block, parent(base.code))) return false;
    set(block, code, true);
    if (shared) set(base.block, base.code, true);
    return true;
}

/// The paper's simplification: first what is finer in the four triangles around the split, then they go.
bool Forest::merge(BlockNumber block, Code code) {
    if (!is_split(block, code)) return true;
    const Partner base = partner(block, code);
    if (base.kind == Partner::Kind::Split || !merge_children(block, code)) return false;
    const bool shared = base.kind == Partner::Kind::Node && is_split(base.block, base.code);
    if (shared && !merge_children(base.block, base.code)) return false;
    set(block, code, false);
    if (shared) set(base.block, base.code, false);
    return true;
}

bool Forest::merge_children(BlockNumber block, Code code) {
    return merge(block, left_child(code)) && merge(block, right_child(code));
}

bool Forest::fold(BlockNumber block, Code code) {
    const Partner base = partner(block, code);
    if (base.kind == Partner::Kind::Split || has_split_child(block, code)) return false;
    const bool shared = base.kind == Partner::Kind::Node;
    if (shared && has_split_child(base.block, base.code)) return false;
    set(block, code, false);
    if (shared) set(base.block, base.code, false);
    return true;
}

void Forest::conjoin(BlockNumber block, Edge edge) {
    if (across(block, edge).kind == Across::Kind::Coarser) match_roots(block, edge);
    const CodeSet standing = trees_[block].split;
    standing.for_each([&](Code code) {
        const bool on_edge = neighbour(code, Side::Base, trees_[block].diagonal).across == edge;
        if (!on_edge || !is_split(block, code)) return;
        const Partner base = partner(block, code);
        const bool matched = base.kind != Partner::Kind::Node || split(base.block, base.code);
        if (!matched) (void)merge(block, code);
    });
}

/// A root's legs are the block's edges: a coarser block must have triangles as small as that beside them.
void Forest::match_roots(BlockNumber block, Edge edge) {
    for (const Code root : {kRootA, kRootB}) {
        for (const Side side : {Side::Left, Side::Right}) {
            if (neighbour(root, side, trees_[block].diagonal).across != edge) continue;
            const Partner leg = beside(block, root, side);
            (void)split(leg.block, parent(leg.code));
        }
    }
}

void Forest::append_triangles(BlockNumber block, std::vector<std::uint16_t>& indices) const {
    const Tree& tree = trees_[block];
    const BlockTriangles& triangles = block_triangles(tree.diagonal);
    // Down the left children first; a right child is the next after the last left one below its sibling.
    for (const Code root : {kRootA, kRootB}) {
        Code code = root;
        while (true) {
            while (is_split(block, code)) code = left_child(code);
            const TriangleVertices& at = triangles[code];
            indices.insert(indices.end(), {at.apex, at.left, at.right});
            while (code != root && !is_left(code)) code = parent(code);
            if (code == root) break;
            code |= 1U;
        }
    }
}

bool Forest::take_changed(BlockNumber block) {
    const bool changed = trees_[block].changed;
    trees_[block].changed = false;
    return changed;
}

}  // namespace eyepoint::terrain::bintree
