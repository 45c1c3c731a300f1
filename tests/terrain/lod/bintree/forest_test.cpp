/// The bintrees of many blocks as one mesh, judged by its edges alone.
#include "terrain/lod/bintree/forest.hpp"

#include <algorithm>
#include <deque>
#include <map>
#include <memory>
#include <random>
#include <set>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "terrain/tiling/tile_edges.hpp"
#include "tests/terrain/lod/drawn_mesh.hpp"

namespace eyepoint::terrain::bintree {
namespace {

using Tiles = std::set<TileId>;

/// A forest over a set of drawn tiles, linked as they lie.
class Blocks {
  public:
    /// Replaces the drawn tiles; those that stay keep their trees.
    void draw(const Tiles& tiles) {
        Tiles fresh;
        for (auto entry = numbers_.begin(); entry != numbers_.end();) {
            if (tiles.contains(entry->first)) {
                ++entry;
                continue;
            }
            forest.remove(entry->second);
            entry = numbers_.erase(entry);
        }
        for (const TileId tile : tiles) {
            if (numbers_.contains(tile)) continue;
            numbers_[tile] = forest.add(tile);
            fresh.insert(tile);
        }
        for (const auto& [tile, number] : numbers_) {
            for (const Edge edge : kEdges) forest.link(number, edge, across(tile, edge));
        }
        for (const auto& [tile, number] : numbers_) {
            for (const Edge edge : kEdges) forest.conjoin(number, edge);
        }
    }

    [[nodiscard]] testing::MeshFaults faults() const {
        std::deque<TileNode> nodes;
        std::deque<BlockMesh> meshes;
        std::vector<BlockDraw> draws;
        for (const auto& [tile, number] : numbers_) {
            TileNode& node = nodes.emplace_back();
            node.tile = tile;
            node.block = kPosts;
            BlockMesh& mesh = meshes.emplace_back();
            forest.append_triangles(number, mesh.indices);
            draws.push_back({&node, {0, static_cast<std::uint32_t>(mesh.indices.size())}, 0, {}, &mesh});
        }
        return testing::find_faults(draws, {});
    }
    [[nodiscard]] std::size_t triangles() const {
        std::vector<std::uint16_t> indices;
        for (const auto& [tile, number] : numbers_) forest.append_triangles(number, indices);
        return indices.size() / 3;
    }
    [[nodiscard]] const std::map<TileId, BlockNumber>& numbers() const { return numbers_; }
    BlockNumber operator[](TileId tile) const { return numbers_.at(tile); }

    Forest forest;

  private:
    Across across(TileId tile, Edge edge) const {
        const auto beside = terrain::neighbour(tile, edge);
        if (!beside) return {};
        const auto number = [&](TileId at) {
            const auto found = numbers_.find(at);
            return found == numbers_.end() ? kNoBlock : found->second;
        };
        if (number(*beside) != kNoBlock) return {Across::Kind::Same, {number(*beside), kNoBlock}};
        const BlockNumber above = number(terrain::parent(*beside));
        if (above != kNoBlock) return {Across::Kind::Coarser, {above, kNoBlock}};
        const auto touching = children_at(opposite(edge));
        const std::array below{number(child(*beside, static_cast<int>(touching[0]))),
                               number(child(*beside, static_cast<int>(touching[1])))};
        if (below[0] == kNoBlock && below[1] == kNoBlock) return {};
        return {Across::Kind::Finer, below};
    }

    static inline const std::shared_ptr<const Block> kPosts = [] {
        auto block = std::make_shared<Block>();
        block->vertices.resize(kBlockVertices);
        return block;
    }();
    std::map<TileId, BlockNumber> numbers_;
};

void expect_whole(const Blocks& blocks, const std::string& when) {
    const testing::MeshFaults faults = blocks.faults();
    EXPECT_GT(faults.edges, 0U) << when;
    ASSERT_EQ(faults.cracks, 0U) << when;
    ASSERT_EQ(faults.overlaps, 0U) << when;
    ASSERT_EQ(faults.folded, 0U) << when;
}

constexpr TileId kAlone{4, 6, 7};

TEST(BintreeForest, ABlockIsTwoTrianglesUntilItIsSplit) {
    Blocks blocks;
    blocks.draw({kAlone});
    EXPECT_EQ(blocks.triangles(), 2U);
    EXPECT_TRUE(blocks.forest.split(blocks[kAlone], kRootA));
    EXPECT_TRUE(blocks.forest.is_split(blocks[kAlone], kRootB)) << "its base neighbour";
    EXPECT_EQ(blocks.triangles(), 4U);
}

TEST(BintreeForest, SplittingEveryNodeDrawsEveryPost) {
    Blocks blocks;
    blocks.draw({kAlone});
    for (Code code = kRootA; code < kSplitCodesEnd; ++code)
        EXPECT_TRUE(blocks.forest.split(blocks[kAlone], code));
    EXPECT_FALSE(blocks.forest.split(blocks[kAlone], kSplitCodesEnd)) << "below the posts";
    EXPECT_EQ(blocks.triangles(), 2U * kBlockCells * kBlockCells);
    expect_whole(blocks, "all split");
}

TEST(BintreeForest, OneDeepSplitBringsItsAncestorsAndTheirBaseNeighboursAndNoMore) {
    // Towards a corner of the block: two splits a level and, the corner being alone, no others. So a side of
    // the corner's triangle is 2^-5 of the block's.
    Blocks blocks;
    blocks.draw({kAlone});
    const auto touches_south_west = [&](Code code) {
        const TriangleVertices& at = block_triangles(diagonal_of(kAlone))[code];
        return at.apex == 0 || at.left == 0 || at.right == 0;
    };
    Code code = kRootB;
    while (level(code) + 1 < kFinestLevel)
        code = touches_south_west(left_child(code)) ? left_child(code) : right_child(code);
    EXPECT_TRUE(blocks.forest.split(blocks[kAlone], code));
    expect_whole(blocks, "one deep split");
    EXPECT_LT(blocks.triangles(), 60U);
    EXPECT_TRUE(blocks.forest.merge(blocks[kAlone], kRootA));
    EXPECT_EQ(blocks.triangles(), 2U) << "merging a root takes all that stands on it";
}

TEST(BintreeForest, FoldingLeavesAloneWhatOthersStandOn) {
    Blocks blocks;
    blocks.draw({kAlone});
    const Code child = left_child(kRootA);
    EXPECT_TRUE(blocks.forest.split(blocks[kAlone], child));
    EXPECT_FALSE(blocks.forest.fold(blocks[kAlone], kRootA));
    EXPECT_FALSE(blocks.forest.fold(blocks[kAlone], kRootB));
    EXPECT_TRUE(blocks.forest.fold(blocks[kAlone], child));
    EXPECT_TRUE(blocks.forest.fold(blocks[kAlone], kRootB));
    EXPECT_EQ(blocks.triangles(), 2U);
}

TEST(BintreeForest, ABlockThatComesIsSubdividedToMeetItsNeighbour) {
    Blocks blocks;
    const TileId east = *terrain::neighbour(kAlone, Edge::East);
    blocks.draw({kAlone});
    for (Code code = kRootA; code < kSplitCodesEnd; ++code) (void)blocks.forest.split(blocks[kAlone], code);
    blocks.draw({kAlone, east});
    expect_whole(blocks, "beside a full block");
    // Along the edge all 32 cells must be there.
    std::vector<std::uint16_t> indices;
    blocks.forest.append_triangles(blocks[east], indices);
    std::set<int> on_edge;
    for (const std::uint16_t index : indices) {
        if (index % kBlockPosts == 0) on_edge.insert(index / kBlockPosts);
    }
    EXPECT_EQ(on_edge.size(), static_cast<std::size_t>(kBlockPosts));
    EXPECT_LT(indices.size() / 3, 400U) << "far from the edge it stays coarse";
}

TEST(BintreeForest, BesideACoarserBlockSplitsOnTheEdgeEndWhereItsPostsDo) {
    Blocks blocks;
    const TileId fine{5, 12, 14};
    const TileId coarse = terrain::parent(*terrain::neighbour(fine, Edge::West));
    blocks.draw({fine});
    for (Code code = kRootA; code < kSplitCodesEnd; ++code) (void)blocks.forest.split(blocks[fine], code);
    blocks.draw({fine, coarse});
    expect_whole(blocks, "a coarser block has come");
    for (Code code = kRootA; code < kSplitCodesEnd; ++code) (void)blocks.forest.split(blocks[fine], code);
    expect_whole(blocks, "and all splits that there can be were made again");
    std::vector<std::uint16_t> indices;
    blocks.forest.append_triangles(blocks[fine], indices);
    for (const std::uint16_t index : indices) {
        const bool on_edge = index % kBlockPosts == 0;
        EXPECT_FALSE(on_edge && (index / kBlockPosts) % 2 == 1) << "row " << index / kBlockPosts;
    }
}

/// A random part of a region over the antimeridian: depths 3 to 5, neighbours one apart at most, some tiles
/// out of view.
Tiles random_cut(std::mt19937_64& random) {
    const auto with = [&](double share) {
        return std::uniform_real_distribution<double>(0.0, 1.0)(random) < share;
    };
    Tiles cut, deep;
    for (std::uint32_t i = 0; i < 12; ++i) {
        const TileId tile{3, (14 + i % 4) % tiles_across(3), 3 + i / 4};
        if (with(0.5)) {
            cut.insert(tile);
            continue;
        }
        for (int quadrant = 0; quadrant < 4; ++quadrant) deep.insert(child(tile, quadrant));
    }
    const auto beside_coarser = [&](TileId tile) {
        return std::any_of(kEdges.begin(), kEdges.end(), [&](Edge edge) {
            const auto beside = terrain::neighbour(tile, edge);
            return beside && cut.contains(terrain::parent(*beside));
        });
    };
    for (const TileId tile : deep) {
        if (beside_coarser(tile) || with(0.6)) {
            cut.insert(tile);
            continue;
        }
        for (int quadrant = 0; quadrant < 4; ++quadrant) cut.insert(child(tile, quadrant));
    }
    std::erase_if(cut, [&](TileId) { return with(0.15); });
    return cut;
}

TEST(BintreeForest, HasNoTJunctionsWhateverIsSplitAndMergedAndComesAndGoes) {
    std::mt19937_64 random(20261122);
    Blocks blocks;
    for (int round = 0; round < 40; ++round) {
        blocks.draw(random_cut(random));
        expect_whole(blocks, "conjoined, round " + std::to_string(round));
        for (int step = 0; step < 120; ++step) {
            auto at = blocks.numbers().begin();
            std::advance(at,
                         std::uniform_int_distribution<std::size_t>(0, blocks.numbers().size() - 1)(random));
            const int depth = std::uniform_int_distribution<int>(0, kFinestLevel - 1)(random);
            const Code first = Code{2} << depth;
            const Code code = std::uniform_int_distribution<Code>(first, first * 2 - 1)(random);
            if (step % 3 == 0) {
                (void)blocks.forest.merge(at->second, code);
            } else {
                (void)blocks.forest.split(at->second, code);
            }
        }
        expect_whole(blocks, "split and merged, round " + std::to_string(round));
        if (HasFatalFailure()) return;
    }
}

}  // namespace
}  // namespace eyepoint::terrain::bintree
