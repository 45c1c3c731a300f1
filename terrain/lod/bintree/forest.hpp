/// The bintrees of all drawn blocks as one mesh without T-junctions: splitting, merging, and conjunction
/// across block borders. Source: He, Wang & Liu, sections 2.4 and 3.2.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "terrain/lod/bintree/code_set.hpp"

namespace eyepoint::terrain::bintree {

using BlockNumber = std::uint32_t;
inline constexpr BlockNumber kNoBlock = 0xffff'ffff;

/// What is drawn across an edge of a block. Depths differ by one at most.
struct Across {
    enum class Kind : std::uint8_t { Nothing, Same, Coarser, Finer };
    Kind kind = Kind::Nothing;
    /// Finer: by half of the edge, from its start (south or west), kNoBlock where nothing is drawn; else the
    /// first.
    std::array<BlockNumber, 2> blocks{kNoBlock, kNoBlock};
    bool operator==(const Across&) const = default;
};

/// A node is there if it is a root or its parent is split; it needs no storage of its own but the bit that
/// says whether it is split itself. Triangles that are drawn are the nodes that are there and not split.
///
/// Between blocks of different depth the coarser one cannot follow below its own posts: there the finer one's
/// triangles on the shared edge stay undivided.
class Forest {
  public:
    /// A node's partner: the triangle of its level on the other side of its base.
    struct Partner {
        enum class Kind : std::uint8_t {
            None,   ///< nothing is drawn there
            Split,  ///< finer blocks are drawn there, whose roots are smaller: as good as split, for good
            Node
        };
        Kind kind = Kind::None;
        BlockNumber block = kNoBlock;
        Code code = 0;  ///< may be beyond the finest level of a coarser block
    };

    /// Its two roots; numbers are used again.
    [[nodiscard]] BlockNumber add(TileId tile);
    /// Nothing may be linked to it any more.
    void remove(BlockNumber block);
    /// A block just linked may not match its neighbours: conjoin() follows, on both sides.
    void link(BlockNumber block, Edge edge, const Across& across) {
        trees_[block].across[static_cast<std::size_t>(edge)] = across;
    }
    [[nodiscard]] const Across& across(BlockNumber block, Edge edge) const {
        return trees_[block].across[static_cast<std::size_t>(edge)];
    }

    /// Makes what is across an edge match the block's splits on it; where it cannot, merges them.
    void conjoin(BlockNumber block, Edge edge);
    /// Splits a node, after its base neighbour, recursively. A node that is not there yet comes with its
    /// ancestors. False where a block's posts end: then nothing finer than its parent is made.
    bool split(BlockNumber block, Code code);
    /// Undoes a split and all splits that stand on it. False where finer blocks stand on it.
    bool merge(BlockNumber block, Code code);
    /// Undoes a split on which nothing stands; false, and unchanged, otherwise.
    bool fold(BlockNumber block, Code code);

    [[nodiscard]] bool is_split(BlockNumber block, Code code) const {
        return code < kSplitCodesEnd && trees_[block].split.has(code);
    }
    [[nodiscard]] const CodeSet& split_nodes(BlockNumber block) const { return trees_[block].split; }
    [[nodiscard]] Partner partner(BlockNumber block, Code code) const {
        return beside(block, code, Side::Base);
    }

    /// The block's drawn triangles, three vertices each, counterclockwise from above, in the order of a walk
    /// down the tree.
    void append_triangles(BlockNumber block, std::vector<std::uint16_t>& indices) const;
    /// Whether splits changed since the last call.
    [[nodiscard]] bool take_changed(BlockNumber block);
    [[nodiscard]] bool changed(BlockNumber block) const { return trees_[block].changed; }

  private:
    struct Tree {
        TileId tile;
        Diagonal diagonal = Diagonal::Rising;
        bool changed = true;
        std::array<Across, 4> across;
        CodeSet split;
    };

    [[nodiscard]] Partner beside(BlockNumber block, Code code, Side side) const;
    [[nodiscard]] bool has_split_child(BlockNumber block, Code code) const {
        return is_split(block, left_child(code)) || is_split(block, right_child(code));
    }
    [[nodiscard]] bool merge_children(BlockNumber block, Code code);
    void match_roots(BlockNumber block, Edge edge);
    void set(BlockNumber block, Code code, bool split);

    std::vector<Tree> trees_;
    std::vector<BlockNumber> free_;
};

}  // namespace eyepoint::terrain::bintree
