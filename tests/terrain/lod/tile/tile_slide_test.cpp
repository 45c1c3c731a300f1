#include "terrain/lod/tile/tile_slide.hpp"

#include <random>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "tests/terrain/lod/rough_block.hpp"

namespace eyepoint::terrain::tiles {
namespace {

/// Table 3's square, a b c / d e f / g h i: its posts as (column, row) from the south-west.
constexpr glm::ivec2 kA{0, 2}, kB{1, 2}, kC{2, 2}, kD{0, 1}, kE{1, 1}, kF{2, 1}, kG{0, 0}, kH{1, 0}, kI{2, 0};

using Ends = std::pair<glm::ivec2, glm::ivec2>;

TEST(Table3, PostsBetweenTwoOfTheNextLevelGoToTheirMean) {
    EXPECT_EQ(ends_of(kB), Ends(kA, kC));
    EXPECT_EQ(ends_of(kD), Ends(kG, kA));
    EXPECT_EQ(ends_of(kF), Ends(kI, kC));
    EXPECT_EQ(ends_of(kH), Ends(kG, kI));
}

TEST(Table3, ThePostInTheMiddleGoesToTheMeanAlongTheCoarseCellsDiagonal) {
    // The paper's square has a and i on it. In fans diagonals take turns: from a fan's middle to its corners.
    EXPECT_EQ(ends_of(kE), Ends(kG, kC));
    EXPECT_EQ(ends_of(kE + glm::ivec2{2, 0}), Ends(kA + glm::ivec2{2, 0}, kI + glm::ivec2{2, 0}));
    EXPECT_EQ(ends_of(kE + glm::ivec2{0, 2}), Ends(kA + glm::ivec2{0, 2}, kI + glm::ivec2{0, 2}));
    EXPECT_EQ(ends_of(kE + glm::ivec2{2, 2}), Ends(kG + glm::ivec2{2, 2}, kC + glm::ivec2{2, 2}));
}

constexpr int kSome = 40;

/// What the paper calls X's level and direction. Its levels grow where tiles get coarser, resolutions fall.
struct Rule {
    const char* name;
    Fineness x, y;
    Fineness edge;  ///< as both draw it
};
void PrintTo(const Rule& rule, std::ostream* out) { *out << rule.name; }

class Table4 : public ::testing::TestWithParam<Rule> {};

TEST_P(Table4, TheBorderIsDrawnAlikeFromBothSides) {
    const Rule& rule = GetParam();
    EXPECT_EQ(border(rule.x, rule.y), rule.edge);
    EXPECT_EQ(border(rule.y, rule.x), rule.edge);
}

INSTANTIATE_TEST_SUITE_P(
    Rules, Table4,
    ::testing::Values(
        // X becomes coarser from Y's level: Y's border morphs along.
        Rule{"SameLevelUp", {9, kSome}, {9, 0}, {9, kSome}},
        // X becomes finer than Y, and is drawn with the finer mesh already: Y's border stands.
        Rule{"SameLevelDown", {10, kSome}, {9, 0}, {9, 0}},
        // X was coarser and becomes as fine as Y: Y's border morphs along.
        Rule{"CoarserDown", {9, kSome}, {9, 0}, {9, kSome}},
        // X is finer and becomes as coarse as Y: Y's border stands.
        Rule{"FinerUp", {10, kSome}, {9, 0}, {9, 0}},
        // Not in the table: both morph.
        Rule{"BothUp", {9, kSome}, {9, kSome + 7}, {9, kSome + 7}},
        Rule{"FinerUpBesideCoarserUp", {10, kSome}, {9, 3}, {9, 3}},
        Rule{"SlidAllTheWay", {10, kSlideSteps}, {9, 0}, {9, 0}},
        Rule{"BothSlidAllTheWay", {9, kSlideSteps}, {9, kSlideSteps}, {9, kSlideSteps}}),
    [](const auto& rule) { return rule.param.name; });

TEST(TileSlide, HalvesTowardsACoarserNeighbourAreStitchedAndMorphWithIt) {
    const Fineness own{10, kSome}, coarser{9, 5};
    const TileSlide slide =
        slide_of(0, 2, own, {&coarser, nullptr, &own, &own, nullptr, nullptr, nullptr, nullptr});
    EXPECT_EQ(slide.stitched, 0b01);
    EXPECT_EQ(slide.border[0], 5);
    EXPECT_EQ(slide.border[1], kSome) << "nothing is beside: as the tile itself";
    EXPECT_EQ(slide.border[2], kSome);
}

std::shared_ptr<const Block> rough_vertices() { return testing::rough_block({10, 1100, 700}); }

std::uint16_t number(glm::ivec2 at) { return static_cast<std::uint16_t>(at.y * kBlockPosts + at.x); }

TEST(TileSlide, AtTheEndOfASlideEveryPostLiesOnTheNextLevelsMesh) {
    const auto block = rough_vertices();
    const SplitPosition eye = split(block->vertices[500].position() + glm::dvec3{100.0, 50.0, 700.0});
    TileSlide slide{.level = 1, .slid = kSlideSteps};
    slide.border.fill(kSlideSteps);
    const auto drawn = [&](glm::ivec2 at) { return slid_vertex(*block, number(at), slide, 1, eye); };
    TileSlide still{.level = 1};
    const auto stored = [&](glm::ivec2 at) { return slid_vertex(*block, number(at), still, 1, eye); };
    for (int row = 0; row <= kBlockCells; row += 2) {
        for (int column = 0; column <= kBlockCells; column += 2) {
            const glm::ivec2 post{column / 2, row / 2};
            if (((post.x | post.y) & 1) == 0) {
                EXPECT_EQ(drawn(2 * post), stored(2 * post));
                continue;
            }
            const auto [a, b] = ends_of(post);
            EXPECT_EQ(drawn(2 * post), 0.5F * (stored(2 * a) + stored(2 * b)));
        }
    }
}

/// Two tiles of one block, so that they share posts: what is proven for them is so for two blocks, whose
/// shared posts have the same bits.
TEST(TileSlide, VerticesOnAnEdgeHaveTheSameBitsFromBothSides) {
    const auto block = rough_vertices();
    const SplitPosition eye = split(block->vertices[0].position() + glm::dvec3{-900.0, 350.0, 70.0});
    std::mt19937 random(5);
    std::uniform_int_distribution<int> steps(0, kSlideSteps), one(0, 1);
    for (int i = 0; i < 200; ++i) {
        const Fineness west{15 - one(random), steps(random)}, east{15 - one(random), steps(random)};
        const auto slide = [&](int part, const Fineness& own, const Fineness& other) {
            std::array<const Fineness*, 8> beside{};
            beside.fill(&other);
            return slide_of(part, 15 - own.resolution, own, beside);
        };
        const TileSlide of_west = slide(0, west, east), of_east = slide(1, east, west);
        const int step = 1 << (15 - border(west, east).resolution);
        for (int row = 0; row <= 16; row += step) {
            EXPECT_EQ(slid_vertex(*block, number({16, row}), of_west, 2, eye),
                      slid_vertex(*block, number({16, row}), of_east, 2, eye));
        }
    }
}

}  // namespace
}  // namespace eyepoint::terrain::tiles
