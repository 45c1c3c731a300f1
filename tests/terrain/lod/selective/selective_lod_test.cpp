#include "terrain/lod/selective/selective_lod.hpp"

#include <string>

#include <gtest/gtest.h>

#include "tests/terrain/lod/method_flight.hpp"
#include "tests/terrain/lod/places.hpp"
#include "tests/terrain/lod/selection_checks.hpp"
#include "tools/bench/allocation_count.hpp"

namespace eyepoint::terrain {
namespace {

using selective::ErrorFormula;
using selective::ReuseTest;
using testing::along;
using testing::index_lists;
using testing::versions;

class SelectiveFlight : public testing::MethodFlight<SelectiveLod> {
  public:
    explicit SelectiveFlight(const selective::Options& options = {})
        : MethodFlight(testing::hills().database(), options) {}
};

TEST(SelectiveLod, MeshIsWholeAndOnlyDikesStandUpright) {
    SelectiveFlight flight;
    for (int step = 0; step < 20; ++step) {
        const LodView view = along(150.0 * step);
        const testing::MeshFaults faults = testing::find_faults(flight.settle(view).draws, {});
        EXPECT_GT(faults.edges, 1000U);
        testing::expect_whole(faults, "step " + std::to_string(step),
                              flight.method().audit(view).dike_triangles);
    }
}

TEST(SelectiveLod, AStillEyeChoosesNothingSendsNothingAndAllocatesNothing) {
    SelectiveFlight flight;
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
    SelectiveFlight flight{{.reuse = ReuseTest::Off}};
    const auto before = index_lists(flight.settle(along(0.0)));
    const Selection& again = flight.step(along(0.0));
    EXPECT_EQ(again.blocks_reused, 0U);
    EXPECT_EQ(index_lists(again), before);
}

TEST(SelectiveLod, AFirstSelectionIsTheSameByEveryReuseTest) {
    for (const ErrorFormula error : {ErrorFormula::Bound, ErrorFormula::Paper}) {
        SelectiveFlight uncached{{error, ReuseTest::Off}};
        const auto expected = index_lists(uncached.settle(along(0.0)));
        for (const ReuseTest reuse : {ReuseTest::FourCorner, ReuseTest::Sound}) {
            SelectiveFlight cached{{error, reuse}};
            EXPECT_EQ(index_lists(cached.settle(along(0.0))), expected);
        }
    }
}

TEST(SelectiveLod, MostSelectionsStandFromFrameToFrame) {
    for (const ReuseTest reuse : {ReuseTest::FourCorner, ReuseTest::Sound}) {
        SelectiveFlight flight{{ErrorFormula::Bound, reuse}};
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
    SelectiveFlight uncached{{.reuse = ReuseTest::Off}}, sound;
    std::uint64_t missed = 0;
    for (int step = 0; step < 60; ++step) {
        const LodView view = along(25.0 * step);
        (void)uncached.settle(view);
        EXPECT_EQ(uncached.method().audit(view).missed, 0U);
        (void)sound.settle(view);
        const SelectionAudit audit = sound.method().audit(view);
        EXPECT_EQ(audit.too_far, 0U) << "step " << step;
        EXPECT_LE(audit.worst_px, 1.1 * 1.0001);
        missed += audit.missed;
    }
    EXPECT_GT(missed, 0U) << "the slack is used";
}

TEST(SelectiveLod, ASmallerToleranceIsKeptAtOnceAndDrawsMore) {
    SelectiveFlight flight;
    std::uint64_t before = 0;
    for (const double tau_px : {2.0, 1.9, 0.7, 0.2}) {
        const LodView view = along(0.0, tau_px, 0.1 * tau_px);
        const std::uint64_t triangles = flight.settle(view).triangles;
        EXPECT_EQ(flight.method().audit(view).too_far, 0U) << "tau " << tau_px;
        EXPECT_GT(triangles, before) << "tau " << tau_px;
        before = triangles;
    }
}

TEST(SelectiveLod, AListThatChangesHasAnotherVersion) {
    SelectiveFlight flight;
    testing::ListHistory history;
    for (int step = 0; step < 30; ++step) history.add(flight.settle(along(20.0 * step)));
    EXPECT_GT(history.changed(), 20U);
    EXPECT_GT(history.kept(), 20U);
}

}  // namespace
}  // namespace eyepoint::terrain
