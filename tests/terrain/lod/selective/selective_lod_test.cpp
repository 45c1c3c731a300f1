#include "terrain/lod/selective/selective_lod.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "terrain/geodesy/earth.hpp"
#include "terrain/pager/pager.hpp"
#include "tests/support/analytic_terrain.hpp"
#include "tests/terrain/lod/drawn_mesh.hpp"
#include "tests/terrain/lod/look.hpp"
#include "tools/bench/allocation_count.hpp"

namespace eyepoint::terrain {
namespace {

using selective::ErrorFormula;
using selective::ReuseTest;

const std::shared_ptr<const Database>& hills() {
    static const testing::ScratchFolder scratch;
    static const std::shared_ptr<const Database> database =
        testing::make_database({.half_size_deg = 0.3}, scratch.path() / "db");
    return database;
}

class HillFlight {
  public:
    explicit HillFlight(const selective::Options& options = {})
        : pager_(std::move(Pager::create(hills(), {.cache_bytes = 1ULL << 30}).value())), lod_(options) {}

    const Selection& step(const LodView& view) { return lod_.select(view, pager_->tree(), ++frame_); }
    const Selection& settle(const LodView& view) {
        while (true) {
            pager_->request(step(view).wishes);
            if (!pager_->wait_for_loads()) return step(view);
            pager_->publish(100000, frame_);
        }
    }
    [[nodiscard]] SelectionAudit audit(const LodView& view) const { return lod_.audit(view); }

  private:
    std::unique_ptr<Pager> pager_;
    SelectiveLod lod_;
    std::uint64_t frame_ = 0;
};

/// North-east and a little down, so many metres along.
LodView along(double metres, double tau_px = 1.0, double slack_px = 0.1) {
    const glm::dmat3 enu = east_north_up(46.5, 8.25);
    const Ecef eye =
        to_ecef({46.5, 8.25, EllipsoidalHeight{2500.0}}) + enu * glm::dvec3{0.7 * metres, 0.7 * metres, 0.0};
    return testing::look(eye, enu * glm::dvec3{0.7, 0.7, -0.2}, enu * glm::dvec3{0.1, 0.05, 1.0}, tau_px,
                         slack_px);
}

std::vector<std::vector<std::uint16_t>> lists(const Selection& selection) {
    std::vector<std::vector<std::uint16_t>> result;
    for (const BlockDraw& draw : selection.draws) result.push_back(draw.mesh->indices);
    return result;
}

std::vector<std::uint64_t> versions(const Selection& selection) {
    std::vector<std::uint64_t> result;
    for (const BlockDraw& draw : selection.draws) result.push_back(draw.mesh->version);
    return result;
}

TEST(SelectiveLod, MeshIsWholeAndOnlyDikesStandUpright) {
    HillFlight flight;
    for (int step = 0; step < 20; ++step) {
        const LodView view = along(150.0 * step);
        const testing::MeshFaults faults = testing::find_faults(flight.settle(view).draws, {});
        EXPECT_GT(faults.edges, 1000U);
        EXPECT_EQ(faults.cracks, 0U) << "step " << step;
        EXPECT_EQ(faults.overlaps, 0U) << "step " << step;
        EXPECT_EQ(faults.unequal_bits, 0U) << "step " << step;
        EXPECT_EQ(faults.folded, flight.audit(view).dike_triangles) << "step " << step;
    }
}

TEST(SelectiveLod, AStillEyeChoosesNothingSendsNothingAndAllocatesNothing) {
    HillFlight flight;
    (void)flight.settle(along(0.0));
    const auto before = versions(flight.step(along(0.0)));
    const LodView view = along(0.0);
    const std::uint64_t allocated = tools::heap_allocations();
    const Selection& again = flight.step(view);
    EXPECT_EQ(tools::heap_allocations() - allocated, 0U);
    EXPECT_EQ(again.blocks_chosen, 0U);
    EXPECT_EQ(versions(again), before);
}

TEST(SelectiveLod, AStillEyeSeesTheSameWithoutACache) {
    HillFlight flight{{.reuse = ReuseTest::Off}};
    const auto before = lists(flight.settle(along(0.0)));
    const Selection& again = flight.step(along(0.0));
    EXPECT_EQ(again.blocks_reused, 0U);
    EXPECT_EQ(lists(again), before);
}

TEST(SelectiveLod, AFirstSelectionIsTheSameByEveryReuseTest) {
    for (const ErrorFormula error : {ErrorFormula::Bound, ErrorFormula::Paper}) {
        HillFlight uncached{{error, ReuseTest::Off}};
        const auto expected = lists(uncached.settle(along(0.0)));
        for (const ReuseTest reuse : {ReuseTest::FourCorner, ReuseTest::Sound}) {
            HillFlight cached{{error, reuse}};
            EXPECT_EQ(lists(cached.settle(along(0.0))), expected);
        }
    }
}

TEST(SelectiveLod, MostSelectionsStandFromFrameToFrame) {
    for (const ReuseTest reuse : {ReuseTest::FourCorner, ReuseTest::Sound}) {
        HillFlight flight{{ErrorFormula::Bound, reuse}};
        for (int frame = 60; frame >= 0; --frame) (void)flight.settle(along(15.0 * frame));
        std::uint64_t chosen = 0, reused = 0;
        for (int frame = 1; frame <= 60; ++frame) {
            const Selection& selection = flight.step(along(15.0 * frame));
            chosen += selection.blocks_chosen;
            reused += selection.blocks_reused;
        }
        EXPECT_GT(chosen, 0U);
        EXPECT_GT(reused, 20 * chosen);
    }
}

TEST(SelectiveLod, WithoutACacheNoVertexIsMissedAndWithTheSoundTestNoneBeyondTauAndSlack) {
    HillFlight uncached{{.reuse = ReuseTest::Off}}, sound;
    std::uint64_t missed = 0;
    for (int step = 0; step < 60; ++step) {
        const LodView view = along(25.0 * step);
        (void)uncached.settle(view);
        EXPECT_EQ(uncached.audit(view).missed, 0U);
        (void)sound.settle(view);
        const SelectionAudit audit = sound.audit(view);
        EXPECT_EQ(audit.too_far, 0U) << "step " << step;
        EXPECT_LE(audit.worst_px, 1.1 * 1.0001);
        missed += audit.missed;
    }
    EXPECT_GT(missed, 0U) << "the slack is used";
}

TEST(SelectiveLod, ASmallerToleranceIsKeptAtOnceAndDrawsMore) {
    HillFlight flight;
    std::uint64_t before = 0;
    for (const double tau_px : {2.0, 1.9, 0.7, 0.2}) {
        const LodView view = along(0.0, tau_px, 0.1 * tau_px);
        const std::uint64_t triangles = flight.settle(view).triangles;
        EXPECT_EQ(flight.audit(view).too_far, 0U) << "tau " << tau_px;
        EXPECT_GT(triangles, before) << "tau " << tau_px;
        before = triangles;
    }
}

TEST(SelectiveLod, AListThatChangesHasAnotherVersion) {
    HillFlight flight;
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

}  // namespace
}  // namespace eyepoint::terrain
