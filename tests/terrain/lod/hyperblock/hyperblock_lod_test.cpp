#include "terrain/lod/hyperblock/hyperblock_lod.hpp"

#include <gtest/gtest.h>

#include "terrain/geodesy/earth.hpp"
#include "terrain/pager/pager.hpp"
#include "tests/support/analytic_terrain.hpp"
#include "tests/terrain/lod/drawn_mesh.hpp"
#include "tests/terrain/lod/look.hpp"
#include "tools/bench/allocation_count.hpp"

namespace eyepoint::terrain {
namespace {

using hyperblock::Options;
using hyperblock::SelectBy;

const std::shared_ptr<const Database>& hills() {
    static const testing::ScratchFolder scratch;
    static const std::shared_ptr<const Database> database =
        testing::make_database({.half_size_deg = 0.3}, scratch.path() / "db");
    return database;
}

class HillFlight {
  public:
    explicit HillFlight(const Options& options = {})
        : pager_(std::move(Pager::create(hills(), {.cache_bytes = 1ULL << 30}).value())), lod_(options) {}

    const Selection& step(const LodView& view) { return lod_.select(view, pager_->tree(), ++frame_); }
    const Selection& settle(const LodView& view) {
        while (true) {
            pager_->request(step(view).wishes);
            if (!pager_->wait_for_loads()) return step(view);
            pager_->publish(100000, frame_);
        }
    }
    [[nodiscard]] const HyperblockLod& lod() const { return lod_; }

  private:
    std::unique_ptr<Pager> pager_;
    HyperblockLod lod_;
    std::uint64_t frame_ = 0;
};

/// North-east and a little down, so many metres along.
LodView along(double metres, double tau_px = 1.0) {
    const glm::dmat3 enu = east_north_up(46.5, 8.25);
    const Ecef eye =
        to_ecef({46.5, 8.25, EllipsoidalHeight{2500.0}}) + enu * glm::dvec3{0.7 * metres, 0.7 * metres, 0.0};
    return testing::look(eye, enu * glm::dvec3{0.7, 0.7, -0.2}, enu * glm::dvec3{0.1, 0.05, 1.0}, tau_px);
}

std::vector<std::uint64_t> versions(const Selection& selection) {
    std::vector<std::uint64_t> result;
    for (const BlockDraw& draw : selection.draws) result.push_back(draw.mesh->version);
    return result;
}

constexpr Options kByBlock[] = {
    {.hyper_level = 0}, {.hyper_level = 1}, {.hyper_level = 2}, {.hyper_level = 3}};
constexpr Options kByVertex{.select_by = SelectBy::Vertex};

class Hyperblock : public ::testing::TestWithParam<Options> {};

TEST_P(Hyperblock, AStillEyeChangesNothingSendsNothingAndAllocatesNothing) {
    HillFlight flight(GetParam());
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
    HillFlight straight(GetParam()), around(GetParam());
    for (const double metres : {900.0, -400.0, 300.0}) (void)around.settle(along(metres, 0.7));
    const Selection &a = straight.settle(along(0.0)), &b = around.settle(along(0.0));
    ASSERT_EQ(a.draws.size(), b.draws.size());
    for (std::size_t i = 0; i < a.draws.size(); ++i)
        EXPECT_EQ(a.draws[i].mesh->indices, b.draws[i].mesh->indices);
}

TEST_P(Hyperblock, ASmallerToleranceDrawsMore) {
    HillFlight flight(GetParam());
    std::uint64_t before = 0;
    for (const double tau_px : {2.0, 0.5, 0.1}) {
        const std::uint64_t triangles = flight.settle(along(0.0, tau_px)).triangles;
        EXPECT_GT(triangles, before) << "tau " << tau_px;
        before = triangles;
    }
}

TEST_P(Hyperblock, AListThatChangesHasAnotherVersion) {
    HillFlight flight(GetParam());
    std::unordered_map<TileId, std::pair<std::uint64_t, std::vector<std::uint16_t>>, TileHash> seen;
    int changed = 0, kept = 0;
    for (int step = 0; step < 30; ++step) {
        for (const BlockDraw& draw : flight.settle(along(20.0 * step)).draws) {
            auto& [version, indices] = seen[draw.node->tile];
            if (version == draw.mesh->version) {
                EXPECT_EQ(indices, draw.mesh->indices);
                ++kept;
            } else {
                ++changed;
            }
            version = draw.mesh->version;
            indices = draw.mesh->indices;
        }
    }
    EXPECT_GT(changed, 20);
    EXPECT_GT(kept, 20);
}

INSTANTIATE_TEST_SUITE_P(Ways, Hyperblock,
                         ::testing::Values(kByBlock[0], kByBlock[1], kByBlock[2], kByBlock[3], kByVertex),
                         [](const auto& instance) {
                             return instance.param.select_by == SelectBy::Vertex
                                        ? std::string("ByVertex")
                                        : "HyperLevel" + std::to_string(instance.param.hyper_level);
                         });

TEST(HyperblockLod, ByVertexTheMeshIsWholeAndOnlyDikesStandUpright) {
    HillFlight flight(kByVertex);
    for (int step = 0; step < 20; ++step) {
        const testing::MeshFaults faults = testing::find_faults(flight.settle(along(150.0 * step)).draws, {});
        EXPECT_GT(faults.edges, 1000U);
        EXPECT_EQ(faults.cracks, 0U) << "step " << step;
        EXPECT_EQ(faults.overlaps, 0U) << "step " << step;
        EXPECT_EQ(faults.unequal_bits, 0U) << "step " << step;
        EXPECT_EQ(faults.folded, flight.lod().dike_triangles()) << "step " << step;
    }
}

TEST(HyperblockLod, ByBlockOnlyDikesStandUprightAndNoEdgeIsInThreeTriangles) {
    for (const Options& options : kByBlock) {
        HillFlight flight(options);
        for (int step = 0; step < 10; ++step) {
            const testing::MeshFaults faults =
                testing::find_faults(flight.settle(along(150.0 * step)).draws, {});
            EXPECT_EQ(faults.overlaps, 0U);
            EXPECT_EQ(faults.unequal_bits, 0U);
            EXPECT_EQ(faults.folded, flight.lod().dike_triangles());
        }
    }
}

TEST(HyperblockLod, BlocksDrawMoreThanVerticesAndSmallBlocksLess) {
    HillFlight by_vertex(kByVertex);
    std::uint64_t before = by_vertex.settle(along(0.0)).triangles;
    for (const int hyper_level : {3, 2, 1, 0}) {
        HillFlight flight({.hyper_level = hyper_level});
        const std::uint64_t triangles = flight.settle(along(0.0)).triangles;
        EXPECT_GT(triangles, before) << "hyperLevel " << hyper_level;
        before = triangles;
    }
}

/// Only that more tiles count as above the horizon where the mesh may lie lower.
TEST(HyperblockLod, WithTilesOfOneToleranceThereAreNoFewerBlocksAtLargerOnes) {
    HillFlight fixed({.blocks_tau_px = 0.5}), free;
    (void)fixed.settle(along(0.0, 0.5));
    (void)free.settle(along(0.0, 0.5));
    const std::uint64_t blocks = fixed.lod().hyper_blocks();
    EXPECT_EQ(free.lod().hyper_blocks(), blocks);
    for (const double tau_px : {1.0, 2.0, 4.0}) {
        (void)fixed.settle(along(0.0, tau_px));
        EXPECT_GE(fixed.lod().hyper_blocks(), blocks) << "tau " << tau_px;
        EXPECT_LT(fixed.lod().hyper_blocks(), blocks * 5 / 4) << "tau " << tau_px;
        (void)free.settle(along(0.0, tau_px));
        EXPECT_LT(free.lod().hyper_blocks(), blocks * 9 / 10) << "tau " << tau_px;
    }
}

}  // namespace
}  // namespace eyepoint::terrain
