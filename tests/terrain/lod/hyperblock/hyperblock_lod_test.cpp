#include "terrain/lod/hyperblock/hyperblock_lod.hpp"

#include <string>

#include <gtest/gtest.h>

#include "tests/terrain/lod/method_flight.hpp"
#include "tests/terrain/lod/places.hpp"
#include "tests/terrain/lod/selection_checks.hpp"
#include "tools/bench/allocation_count.hpp"

namespace eyepoint::terrain {
namespace {

using hyperblock::Options;
using hyperblock::SelectBy;
using testing::along;
using testing::index_lists;
using testing::versions;

class HyperblockFlight : public testing::MethodFlight<HyperblockLod> {
  public:
    explicit HyperblockFlight(const Options& options = {})
        : MethodFlight(testing::hills().database(), options) {}
};

constexpr Options kByBlock[] = {
    {.hyper_level = 0}, {.hyper_level = 1}, {.hyper_level = 2}, {.hyper_level = 3}};
constexpr Options kByVertex{.select_by = SelectBy::Vertex};

class Hyperblock : public ::testing::TestWithParam<Options> {};

TEST_P(Hyperblock, AStillEyeChangesNothingSendsNothingAndAllocatesNothing) {
    HyperblockFlight flight(GetParam());
    (void)flight.settle(along(0.0));
    const auto before = versions(flight.step(along(0.0)));
    const LodView view = along(0.0);
    const std::uint64_t allocated = tools::heap_allocations();
    const Selection& again = flight.step(view);
    EXPECT_EQ(tools::heap_allocations() - allocated, 0U);
    EXPECT_EQ(again.blocks_chosen, 0U);
    EXPECT_EQ(versions(again), before);
}

TEST_P(Hyperblock, TheMeshDependsOnTheViewAlone) {
    HyperblockFlight straight(GetParam()), around(GetParam());
    for (const double metres : {900.0, -400.0, 300.0}) (void)around.settle(along(metres, 0.7));
    EXPECT_EQ(index_lists(around.settle(along(0.0))), index_lists(straight.settle(along(0.0))));
}

TEST_P(Hyperblock, ASmallerToleranceDrawsMore) {
    HyperblockFlight flight(GetParam());
    std::uint64_t before = 0;
    for (const double tau_px : {2.0, 0.5, 0.1}) {
        const std::uint64_t triangles = flight.settle(along(0.0, tau_px)).triangles;
        EXPECT_GT(triangles, before) << "tau " << tau_px;
        before = triangles;
    }
}

TEST_P(Hyperblock, AListThatChangesHasAnotherVersion) {
    HyperblockFlight flight(GetParam());
    testing::ListHistory history;
    for (int step = 0; step < 30; ++step) history.add(flight.settle(along(20.0 * step)));
    EXPECT_GT(history.changed(), 20U);
    EXPECT_GT(history.kept(), 20U);
}

INSTANTIATE_TEST_SUITE_P(Ways, Hyperblock,
                         ::testing::Values(kByBlock[0], kByBlock[1], kByBlock[2], kByBlock[3], kByVertex),
                         [](const auto& instance) {
                             return instance.param.select_by == SelectBy::Vertex
                                        ? std::string("ByVertex")
                                        : "HyperLevel" + std::to_string(instance.param.hyper_level);
                         });

TEST(HyperblockLod, ByVertexTheMeshIsWholeAndOnlyDikesStandUpright) {
    HyperblockFlight flight(kByVertex);
    for (int step = 0; step < 20; ++step) {
        const testing::MeshFaults faults = testing::find_faults(flight.settle(along(150.0 * step)).draws, {});
        EXPECT_GT(faults.edges, 1000U);
        testing::expect_whole(faults, "step " + std::to_string(step), flight.method().dike_triangles());
    }
}

TEST(HyperblockLod, ByBlockOnlyDikesStandUprightAndNoEdgeIsInThreeTriangles) {
    for (const Options& options : kByBlock) {
        HyperblockFlight flight(options);
        for (int step = 0; step < 10; ++step) {
            const testing::MeshFaults faults =
                testing::find_faults(flight.settle(along(150.0 * step)).draws, {});
            EXPECT_EQ(faults.overlaps, 0U);
            EXPECT_EQ(faults.unequal_bits, 0U);
            EXPECT_EQ(faults.folded, flight.method().dike_triangles());
        }
    }
}

TEST(HyperblockLod, BlocksDrawMoreThanVerticesAndSmallBlocksLess) {
    HyperblockFlight by_vertex(kByVertex);
    std::uint64_t before = by_vertex.settle(along(0.0)).triangles;
    for (const int hyper_level : {3, 2, 1, 0}) {
        HyperblockFlight flight({.hyper_level = hyper_level});
        const std::uint64_t triangles = flight.settle(along(0.0)).triangles;
        EXPECT_GT(triangles, before) << "hyperLevel " << hyper_level;
        before = triangles;
    }
}

/// Only that more tiles count as above the horizon where the mesh may lie lower.
TEST(HyperblockLod, WithTilesOfOneToleranceThereAreNoFewerBlocksAtLargerOnes) {
    HyperblockFlight fixed({.blocks_tau_px = 0.5}), free;
    (void)fixed.settle(along(0.0, 0.5));
    (void)free.settle(along(0.0, 0.5));
    const std::uint64_t blocks = fixed.method().hyper_blocks();
    EXPECT_EQ(free.method().hyper_blocks(), blocks);
    for (const double tau_px : {1.0, 2.0, 4.0}) {
        (void)fixed.settle(along(0.0, tau_px));
        EXPECT_GE(fixed.method().hyper_blocks(), blocks) << "tau " << tau_px;
        EXPECT_LT(fixed.method().hyper_blocks(), blocks * 5 / 4) << "tau " << tau_px;
        (void)free.settle(along(0.0, tau_px));
        EXPECT_LT(free.method().hyper_blocks(), blocks * 9 / 10) << "tau " << tau_px;
    }
}

}  // namespace
}  // namespace eyepoint::terrain
