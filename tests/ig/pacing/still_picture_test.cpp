#include "ig/pacing/still_picture.hpp"

#include <gtest/gtest.h>

namespace eyepoint::ig {
namespace {

/// A picture of a view that has been drawn twice, with nothing left to come.
StillPicture settled(const View& view, const FrameStatistics& statistics = {}) {
    StillPicture picture;
    picture.drawn(view, std::nullopt, statistics);
    picture.drawn(view, std::nullopt, statistics);
    return picture;
}

TEST(StillPicture, HoldsNothingBeforeTheFirstFrame) {
    EXPECT_FALSE(StillPicture().holds(View{}, std::nullopt));
}

TEST(StillPicture, HoldsWhileNothingChanges) {
    const View view{.width_px = 64, .height_px = 48};
    EXPECT_TRUE(settled(view).holds(view, std::nullopt));
}

TEST(StillPicture, TheLeastMovementTurnOrSizeIsAChange) {
    const View view{.width_px = 64, .height_px = 48};
    View moved = view, turned = view, larger = view, zoomed = view;
    moved.eye_ecef.x += 1e-9;
    turned.axes[2].y += 1e-9;
    larger.width_px = 65;
    zoomed.top *= 1.001;
    for (const View& other : {moved, turned, larger, zoomed})
        EXPECT_FALSE(settled(view).holds(other, std::nullopt));
}

TEST(StillPicture, AnotherShowIsAChange) { EXPECT_FALSE(settled(View{}).holds(View{}, Show::Wireframe)); }

TEST(StillPicture, TerrainThatIsStillComingIsAChange) {
    EXPECT_FALSE(settled(View{}, {.loads_pending = 1}).holds(View{}, std::nullopt));
    EXPECT_FALSE(settled(View{}, {.blocks_uploaded = 1}).holds(View{}, std::nullopt));
}

TEST(StillPicture, AToleranceThatMovesIsAChangeUntilItRests) {
    StillPicture picture = settled(View{}, {.tau_px = 2.0});
    picture.drawn(View{}, std::nullopt, {.tau_px = 1.9});
    EXPECT_FALSE(picture.holds(View{}, std::nullopt));
    picture.drawn(View{}, std::nullopt, {.tau_px = 1.9});
    EXPECT_TRUE(picture.holds(View{}, std::nullopt));
}

}  // namespace
}  // namespace eyepoint::ig
