#include "terrain/lod/hyperblock/hyper_tree.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include "terrain/lod/hyperblock/hyperblock_options.hpp"
#include "terrain/lod/hyperblock/level_adjustment.hpp"
#include "tests/terrain/lod/hyperblock/patchy_tile.hpp"

namespace eyepoint::terrain::hyperblock {
namespace {

using testing::PatchyTile;

/// A seed with bumps and plains.
constexpr unsigned kPatched = 4;

int row_of(int post) { return post / kBlockPosts; }
int column_of(int post) { return post % kBlockPosts; }

/// Twice the area on the grid, in cells; positive counterclockwise.
int area(int a, int b, int c) {
    return (column_of(b) - column_of(a)) * (row_of(c) - row_of(a)) -
           (column_of(c) - column_of(a)) * (row_of(b) - row_of(a));
}

/// What a list of triangles covers, and the edges that only one of them has.
struct Cover {
    int area = 0;
    bool folded = false;
    std::map<std::pair<int, int>, int> open;  ///< directed edges less their reverses

    void add(std::span<const std::uint16_t> triangles) {
        for (std::size_t i = 0; i < triangles.size(); i += 3) {
            const int twice =
                eyepoint::terrain::hyperblock::area(triangles[i], triangles[i + 1], triangles[i + 2]);
            folded = folded || twice <= 0;
            area += twice;
            for (std::size_t c = 0; c < 3; ++c) {
                const int from = triangles[i + c], to = triangles[i + (c + 1) % 3];
                open[std::minmax(from, to)] += from < to ? 1 : -1;
            }
        }
    }
    /// Every edge inside the tile is in two triangles, once in each direction.
    [[nodiscard]] bool whole() const {
        return std::ranges::all_of(open, [](const auto& edge) {
            const auto& [ends, uses] = edge;
            const auto along = [&](auto of) {
                const int a = of(ends.first), b = of(ends.second);
                return a == b && (a == 0 || a == kBlockCells);
            };
            return uses == 0 || along(row_of) || along(column_of);
        });
    }
};

TileBlocks blocks_of(PatchyTile& tile) {
    TileBlocks blocks;
    blocks.tile = testing::kPatchyTile;
    blocks.tree = tile.tree;
    blocks.choices = no_choices(blocks.tree);
    return blocks;
}

/// Random basic levels, adjusted.
TileBlocks random_choice(PatchyTile& tile, std::mt19937& random) {
    TileBlocks blocks = blocks_of(tile);
    for (std::size_t i = 0; i < blocks.choices.size(); ++i)
        blocks.choices[i].level = static_cast<std::int8_t>(random() % blocks.tree.blocks[i].level_count);
    TileBlocks* const one[] = {&blocks};
    LevelAdjustment().adjust(one);
    return blocks;
}

RC_GTEST_PROP(HyperTree, BlocksMeetAtWhateverLevels, ()) {
    const int hyper_level = *rc::gen::inRange(0, kMostHyperLevel + 1);
    const auto seed = *rc::gen::arbitrary<unsigned>();
    PatchyTile tile(seed, hyper_level);
    std::mt19937 random(seed);
    for (int i = 0; i < 8; ++i) {
        const TileBlocks blocks = random_choice(tile, random);
        Cover cover;
        for (std::size_t b = 0; b < blocks.choices.size(); ++b)
            cover.add(
                blocks.tree.strip(blocks.tree.blocks[b], blocks.choices[b].level, blocks.choices[b].border));
        RC_ASSERT(!cover.folded);
        RC_ASSERT(cover.area == 2 * kBlockCells * kBlockCells);
        RC_ASSERT(cover.whole());
    }
}

/// Both blocks of every pair of neighbours, all levels that adjustment can leave and all border types: one
/// edge line.
TEST(HyperTree, ExtendedBorderIsTheNextLevelsAndTheOthersStay) {
    PatchyTile tile(kPatched, 1, 10.0F);
    for (const HyperBlock& block : tile.tree.blocks) {
        for (int level = 0; level < block.level_count; ++level) {
            const unsigned extendable = block.level(level).extendable;
            const auto basic = tile.tree.strip(block, level, 0);
            for (unsigned border = 1; border < kBorderTypes; ++border) {
                if ((border & ~extendable) != 0) continue;
                const auto strip = tile.tree.strip(block, level, static_cast<BorderType>(border));
                EXPECT_GT(strip.size(), basic.size());
                for (const std::uint16_t post : basic) EXPECT_NE(std::ranges::find(strip, post), strip.end());
            }
        }
    }
}

RC_GTEST_PROP(HyperTree, LevelErrorBoundsEveryPostOfEveryTriangulation, ()) {
    PatchyTile tile(*rc::gen::arbitrary<unsigned>(), *rc::gen::inRange(0, kMostHyperLevel + 1));
    const auto height_m = [&](int post) {
        return double{tile.block->data.height_m(row_of(post), column_of(post))};
    };
    for (const HyperBlock& block : tile.tree.blocks) {
        const int level = *rc::gen::inRange(0, int{block.level_count});
        const auto border =
            static_cast<BorderType>(*rc::gen::inRange(0U, 16U) & block.level(level).extendable);
        const auto strip = tile.tree.strip(block, level, border);
        const double error_m = block.level(level).error_m - testing::kPatchyUnseenM;
        for (std::size_t i = 0; i < strip.size(); i += 3) {
            const int a = strip[i], b = strip[i + 1], c = strip[i + 2];
            for (int post = 0; post < kBlockVertices; ++post) {
                const int of_a = area(post, b, c), of_b = area(a, post, c), of_c = area(a, b, post);
                if (of_a < 0 || of_b < 0 || of_c < 0) continue;
                const double drawn_m =
                    (of_a * height_m(a) + of_b * height_m(b) + of_c * height_m(c)) / area(a, b, c);
                RC_ASSERT(std::abs(drawn_m - height_m(post)) <= error_m + 1e-3);
            }
        }
    }
}

TEST(HyperTree, BranchesEndEarlyInSpecialBlocks) {
    std::size_t normal = 0, special = 0, early = 0;
    for (unsigned seed = 0; seed < 20; ++seed) {
        PatchyTile tile(seed, kMostHyperLevel);
        for (const HyperBlock& block : tile.tree.blocks) {
            if (!block.is_special) {
                EXPECT_EQ(block.depth, kMostHyperLevel);
                EXPECT_GT(block.level_count, 1);
                ++normal;
                continue;
            }
            ++special;
            early += block.depth < kMostHyperLevel ? 1 : 0;
            EXPECT_EQ(block.level_count, 1);
            EXPECT_LE(tile.tree.strip(block, 0, 0).size(), 6U);
        }
    }
    EXPECT_GT(normal, 100U);
    EXPECT_GT(special, early);
    EXPECT_GT(early, 20U);
}

TEST(HyperTree, APlainIsOneSpecialBlock) {
    PatchyTile tile(2, kMostHyperLevel, 1e6F);
    ASSERT_EQ(tile.tree.blocks.size(), 1U);
    EXPECT_TRUE(tile.tree.blocks[0].is_special);
    EXPECT_EQ(tile.tree.strip(tile.tree.blocks[0], 0, 0).size(), 6U);
}

TEST(HyperTree, SpheresHoldWhatIsDrawnAndWhatIsBelow) {
    for (const unsigned seed : {1U, 3U, kPatched}) {
        PatchyTile tile(seed, 2);
        for (const HyperBlock& block : tile.tree.blocks) {
            for (int level = 0; level < block.level_count; ++level) {
                for (const std::uint16_t post : tile.tree.strip(block, level, 0)) {
                    const glm::vec3 at{tile.block->vertices[post].position() - tile.posts.origin};
                    EXPECT_LE(glm::distance(at, block.bounds.centre_m), block.bounds.radius_m);
                }
            }
        }
        for (const TreeNode& node : tile.tree.nodes) {
            if (node.first_child < 0) continue;
            for (std::int16_t child = 0; child < 4; ++child) {
                const Sphere& below =
                    tile.tree.nodes[static_cast<std::size_t>(node.first_child + child)].bounds;
                EXPECT_LE(glm::distance(below.centre_m, node.bounds.centre_m) + below.radius_m,
                          node.bounds.radius_m * 1.000001F);
            }
        }
    }
}

/// Of the blocks that cover two quads, row and column.
void expect_adjusted(const TileBlocks& blocks, std::pair<int, int> one, std::pair<int, int> other) {
    const auto a = blocks.tree.at(one.first, one.second), b = blocks.tree.at(other.first, other.second);
    const HyperBlock &first = blocks.tree.blocks[a], &second = blocks.tree.blocks[b];
    if (first.is_special || second.is_special) return;
    const int of_a = blocks.choices[a].level, of_b = blocks.choices[b].level;
    EXPECT_TRUE(of_a >= of_b - 1 || of_a == first.finest());
    EXPECT_TRUE(of_b >= of_a - 1 || of_b == second.finest());
}

TEST(LevelAdjustment, NeighboursDifferByOneAtMostUnlessOneHasNoMoreLevels) {
    std::mt19937 random(1);
    for (const unsigned seed : {1U, 3U, kPatched, 5U}) {
        PatchyTile tile(seed, 2);
        for (int i = 0; i < 20; ++i) {
            const TileBlocks blocks = random_choice(tile, random);
            for (int row = 0; row < 4; ++row) {
                for (int column = 0; column < 4; ++column) {
                    if (column < 3) expect_adjusted(blocks, {row, column}, {row, column + 1});
                    if (row < 3) expect_adjusted(blocks, {row, column}, {row + 1, column});
                }
            }
        }
    }
}

TEST(LevelAdjustment, RaisesTheLowerOneOnly) {
    std::mt19937 random(9);
    PatchyTile tile(kPatched, 2);
    TileBlocks blocks = blocks_of(tile);
    for (std::size_t i = 0; i < blocks.choices.size(); ++i)
        blocks.choices[i].level = static_cast<std::int8_t>(random() % blocks.tree.blocks[i].level_count);
    const auto before = blocks.choices;
    TileBlocks* const one[] = {&blocks};
    LevelAdjustment().adjust(one);
    for (std::size_t i = 0; i < before.size(); ++i) EXPECT_GE(blocks.choices[i].level, before[i].level);
}

}  // namespace
}  // namespace eyepoint::terrain::hyperblock
