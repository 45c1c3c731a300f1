#include "terrain/lod/bintree/bintree_lod.hpp"

#include <random>
#include <string>

#include <gtest/gtest.h>

#include "tests/terrain/lod/method_flight.hpp"
#include "tests/terrain/lod/places.hpp"
#include "tests/terrain/lod/selection_checks.hpp"
#include "tools/bench/allocation_count.hpp"

namespace eyepoint::terrain {
namespace {

using testing::expect_whole;
using testing::find_faults;
using testing::hills;
using testing::index_lists;
using testing::look_from;
using testing::versions;

using BintreeFlight = testing::MethodFlight<BintreeLod>;

class BintreeLodAt : public ::testing::TestWithParam<testing::Place> {};

TEST_P(BintreeLodAt, DrawnMeshHasNoCracksFromRandomEyesNorWhileBlocksArrive) {
    const testing::AnalyticPlanet& planet = GetParam().planet();
    BintreeFlight flight{planet.database()};
    std::mt19937_64 random(20261122);
    for (int i = 0; i < 8; ++i) {
        const LodView view = testing::random_view(planet.terrain(), random);
        for (int frame = 0; frame < 4; ++frame) {
            expect_whole(find_faults(flight.step(view).draws, {}), "arriving, eye " + std::to_string(i));
            flight.receive(5);
        }
        expect_whole(find_faults(flight.settle(view).draws, {}), "loaded, eye " + std::to_string(i));
    }
}

INSTANTIATE_TEST_SUITE_P(Earth, BintreeLodAt, ::testing::ValuesIn(testing::places()), testing::place_name);

TEST(BintreeLod, ATurningEyeSeesNoCracksAsBlocksComeAndGo) {
    BintreeFlight flight{hills().database()};
    (void)flight.settle(look_from(2500.0, 0.0, 10.0, 1.0));
    for (int frame = 0; frame < 60; ++frame) {
        const LodView view = look_from(2500.0 + 15.0 * frame, 7.0 * frame, 10.0, 1.0);
        expect_whole(find_faults(flight.step(view).draws, {}), "frame " + std::to_string(frame));
        flight.receive(4);
    }
}

TEST(BintreeLod, ASmallerToleranceDrawsMore) {
    BintreeFlight flight{hills().database()};
    std::uint64_t before = 0;
    for (const double tau_px : {8.0, 2.0, 0.5}) {
        const std::uint64_t triangles = flight.settle(look_from(3000.0, 0.0, 35.0, tau_px)).triangles;
        EXPECT_GT(triangles, before) << "tau " << tau_px;
        before = triangles;
    }
}

TEST(BintreeLod, TheMeshDependsOnTheViewNotOnTheWayThere) {
    const LodView here = look_from(2500.0, 40.0, 12.0, 1.0);
    BintreeFlight direct{hills().database()};
    const auto expected = index_lists(direct.settle(here));
    BintreeFlight round_about{hills().database()};
    for (const LodView& view : {look_from(1500.0, 20.0, 5.0, 0.7), look_from(9000.0, 55.0, 60.0, 1.0),
                                look_from(2500.0, 220.0, 12.0, 4.0)})
        (void)round_about.settle(view);
    EXPECT_EQ(index_lists(round_about.settle(here)), expected);
}

TEST(BintreeLod, AStillEyeJudgesNothingAgainSendsNothingAndAllocatesNothing) {
    BintreeFlight flight{hills().database()};
    const LodView view = look_from(2500.0, 40.0, 12.0, 1.0);
    (void)flight.settle(view);
    const auto before = versions(flight.step(view));
    const std::uint64_t allocated = tools::heap_allocations();
    const Selection& again = flight.step(view);
    EXPECT_EQ(tools::heap_allocations() - allocated, 0U);
    EXPECT_EQ(again.blocks_chosen, 0U);
    EXPECT_EQ(versions(again), before);
}

TEST(BintreeLod, AListThatChangesHasAnotherVersion) {
    BintreeFlight flight{hills().database()};
    testing::ListHistory history;
    for (int frame = 0; frame < 20; ++frame)
        history.add(flight.settle(look_from(2500.0 + 20.0 * frame, 40.0, 12.0, 1.0)));
    EXPECT_GT(history.changed(), 20U);
    EXPECT_GT(history.kept(), 20U);
}

TEST(BintreeLod, ABudgetIsUsedAndKeptWhereTheToleranceAsksForMore) {
    for (const std::uint32_t budget : {5000U, 10000U, 20000U}) {
        BintreeFlight flight{hills().database(), budget};
        for (int frame = 0; frame < 20; ++frame) {
            const LodView view = look_from(2500.0, 40.0 + frame, 12.0, 0.1);
            const Selection& selection = flight.settle(view);
            expect_whole(find_faults(selection.draws, {}), std::to_string(budget));
            EXPECT_LE(selection.triangles, budget) << "frame " << frame;
            EXPECT_GE(selection.triangles, budget * 9 / 10) << "frame " << frame;
        }
        const auto still = index_lists(flight.step(look_from(2500.0, 60.0, 12.0, 0.1)));
        const auto again = index_lists(flight.step(look_from(2500.0, 60.0, 12.0, 0.1)));
        EXPECT_EQ(again, still) << "a still eye";
    }
}

TEST(BintreeLod, ABudgetThatSufficesChangesNothing) {
    const LodView view = look_from(2500.0, 40.0, 12.0, 2.0);
    BintreeFlight free{hills().database()}, bound{hills().database(), 1000000};
    EXPECT_EQ(index_lists(bound.settle(view)), index_lists(free.settle(view)));
}

/// A node is there or not, split or not, wanted or not, by its code: bits in two sets a block. Two roots
/// whose leaves are n triangles have 2n - 2 nodes.
TEST(BintreeLod, AnActiveNodeTakesAtMost16Bytes) {
    for (const std::uint32_t budget : {0U, 20000U, 5000U}) {
        BintreeFlight flight{hills().database(), budget};
        std::uint64_t nodes = 0, bits_bytes = 0, error_bytes = 0;
        for (const BlockDraw& draw : flight.settle(look_from(2500.0, 40.0, 12.0, 0.1)).draws) {
            nodes += std::uint64_t{draw.indices.count} / 3 * 2 - 2;
            bits_bytes += 2 * sizeof(bintree::CodeSet);
            error_bytes += sizeof(bintree::SplitVertices);
        }
        ASSERT_GT(nodes, 1000U);
        EXPECT_LE(bits_bytes, 16 * nodes) << "budget " << budget;
        // Errors are there for all posts of a block, however few of them a budget leaves.
        if (budget == 0) {
            EXPECT_LE(bits_bytes + error_bytes, 16 * nodes);
        }
        RecordProperty("milli_bytes_a_node_" + std::to_string(budget),
                       static_cast<int>(1000 * bits_bytes / nodes));
    }
}

}  // namespace
}  // namespace eyepoint::terrain
