#include "terrain/lod/selective/block_selection.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <random>
#include <utility>

#include <gtest/gtest.h>

namespace eyepoint::terrain::selective {
namespace {

const DependencyHierarchy& hierarchy() { return DependencyHierarchy::of_block(); }

/// Each vertex fails the test with a probability.
TestedPosts tested_at_random(std::mt19937_64& random, double failing) {
    TestedPosts tested;
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (Rank rank = 0; rank < kRanks; ++rank) {
        tested.passes_by[rank] = unit(random) < failing ? -1.0F : 1.0F;
        tested.stands_for_m[rank] = static_cast<float>(1.0 + unit(random));
    }
    return tested;
}

/// By definition: what fails, and all that it stands on.
std::vector<bool> closure(const TestedPosts& tested) {
    std::vector<bool> selected(kRanks);
    for (Rank rank = 0; rank < kRanks; ++rank) {
        if (tested.passes_by[rank] < 0.0F) selected[rank] = true;
        if (!selected[rank]) continue;
        for (const Rank parent : hierarchy().vertices()[rank].parents)
            if (parent != kNoRank) selected[parent] = true;
    }
    return selected;
}

void expect_locks_count_active_children(const BlockSelection& selection) {
    std::vector<int> children(kRanks);
    for (Rank rank = 0; rank < kRanks; ++rank) {
        if (!selection.active(rank)) continue;
        for (const Rank parent : hierarchy().vertices()[rank].parents)
            if (parent != kNoRank) ++children[parent];
    }
    for (Rank rank = 0; rank < kRanks; ++rank) {
        EXPECT_GE(selection.lock(rank), 0);
        EXPECT_EQ(selection.lock(rank), children[rank]);
        EXPECT_TRUE(selection.lock(rank) == 0 || selection.active(rank));
    }
}

/// The triangles are one sheet over the whole block, counterclockwise, its rim the selected border vertices.
void expect_whole(const std::vector<std::uint16_t>& indices, const BlockSelection& selection) {
    std::map<std::pair<int, int>, int> uses;
    int twice_area = 0;
    for (std::size_t i = 0; i < indices.size(); i += 3) {
        const auto row = [&](std::size_t c) { return indices[i + c] / kBlockPosts; };
        const auto column = [&](std::size_t c) { return indices[i + c] % kBlockPosts; };
        const int turn =
            (column(1) - column(0)) * (row(2) - row(0)) - (column(2) - column(0)) * (row(1) - row(0));
        EXPECT_GT(turn, 0);
        twice_area += turn;
        for (std::size_t c = 0; c < 3; ++c) ++uses[{indices[i + c], indices[i + (c + 1) % 3]}];
    }
    EXPECT_EQ(twice_area, 2 * kBlockCells * kBlockCells);
    int rim = 0, vertices_on_rim = 4;
    for (const auto& [edge, count] : uses) {
        EXPECT_EQ(count, 1);
        if (!uses.contains({edge.second, edge.first})) ++rim;
    }
    for (const std::uint32_t bits : selection.border()) vertices_on_rim += std::popcount(bits);
    EXPECT_EQ(rim, vertices_on_rim);
}

TEST(BlockSelection, NothingFailsAndTwoTrianglesAreDrawn) {
    std::mt19937_64 random(1);
    BlockSelection selection;
    std::vector<std::uint16_t> indices;
    selection.select(tested_at_random(random, 0.0), indices);
    EXPECT_EQ(indices.size(), 6U);
    expect_whole(indices, selection);
}

TEST(BlockSelection, EverythingFailsAndEveryCellIsDrawn) {
    std::mt19937_64 random(1);
    BlockSelection selection;
    std::vector<std::uint16_t> indices;
    selection.select(tested_at_random(random, 1.0), indices);
    EXPECT_EQ(indices.size(), std::size_t{3} * 2 * kBlockCells * kBlockCells);
    expect_whole(indices, selection);
    EXPECT_EQ(selection.border(), (BorderSelection{0xffff'fffe, 0xffff'fffe, 0xffff'fffe, 0xffff'fffe}));
}

TEST(BlockSelection, IsWhatFailsAndAllItStandsOnWhateverWasSelectedBefore) {
    std::mt19937_64 random(20261122);
    BlockSelection selection;
    for (int i = 0; i < 300; ++i) {
        const double failing = std::pow(10.0, -4.0 * std::uniform_real_distribution<double>()(random));
        const TestedPosts tested = tested_at_random(random, i % 10 == 9 ? 0.0 : failing);
        std::vector<std::uint16_t> indices{7};
        selection.select(tested, indices);
        const std::vector<bool> expected = closure(tested);
        float stands_for_m = 1e30F;
        for (Rank rank = 0; rank < kRanks; ++rank) {
            EXPECT_EQ(selection.active(rank), expected[rank]) << "selection " << i << ", rank " << rank;
            if (!expected[rank]) stands_for_m = std::min(stands_for_m, tested.stands_for_m[rank]);
        }
        EXPECT_EQ(selection.stands_for_m(), stands_for_m);
        expect_locks_count_active_children(selection);
        EXPECT_EQ(indices.front(), 7) << "appended";
        indices.erase(indices.begin());
        expect_whole(indices, selection);
    }
}

TEST(BlockSelection, AllLocksAreZeroAfterEverythingIsDeselected) {
    std::mt19937_64 random(3);
    BlockSelection selection;
    std::vector<std::uint16_t> indices;
    for (const double failing : {1.0, 0.5, 0.05, 0.005}) {
        selection.select(tested_at_random(random, failing), indices);
        selection.select(tested_at_random(random, 0.0), indices);
        for (Rank rank = 0; rank < kRanks; ++rank) {
            EXPECT_EQ(selection.lock(rank), 0);
            EXPECT_FALSE(selection.active(rank));
        }
    }
}

}  // namespace
}  // namespace eyepoint::terrain::selective
