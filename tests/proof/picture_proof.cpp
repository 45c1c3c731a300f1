/// Pictures by the nested method do not depend on what was drawn before: a still eye's are the same bits, and
/// so are those of choices kept from earlier frames and of choices made anew.
#include <gtest/gtest.h>

#include "tests/picture/flights.hpp"
#include "tests/picture/renderer.hpp"

namespace eyepoint::testing {
namespace {

constexpr ig::PictureSize kSize{640, 480};

ig::SceneOptions nested_options() {
    ig::SceneOptions options;
    options.lod_method = "nested";
    options.tau_px = 1.0;
    options.shading = ig::Shading::Forward;  // chosen by time, it could differ between two scenes
    return options;
}

class NestedPicture : public ::testing::Test {
  protected:
    std::vector<ig::FlightEye> eyes = eyes_of(sample_flight(), kSize, 30.0);
};

/// The eye comes from afar, so that choices of many ages stand, wanders until others are made, and is back.
TEST_F(NestedPicture, OfAStillEyeIsTheSameBitsAlsoWhileChoicesExpire) {
    Renderer renderer(open_synthetic_terrain(), kSize, nested_options());
    constexpr std::size_t kHere = 600, kRound = 90;
    for (std::size_t i = 0; i <= kHere; i += 10) (void)renderer.draw_complete(eyes[i].eyepoint.view);
    const ig::View& here = eyes[kHere].eyepoint.view;
    const ig::Picture first = renderer.draw_complete(here);
    keep_for_looking(first, "nested-still");
    ig::Picture again;
    for (int frame = 0; frame < 5; ++frame) {
        (void)renderer.draw_now(here, again);
        EXPECT_EQ(first.rgba, again.rgba) << "still, frame " << frame;
    }
    for (std::size_t away = 10; away <= kRound; away += 20) {
        (void)renderer.draw_complete(eyes[kHere + away].eyepoint.view);
        (void)renderer.draw_complete(here);
        (void)renderer.draw_now(here, again);
        EXPECT_EQ(first.rgba, again.rgba) << "back from " << away << " frames ahead";
    }
}

/// A scene that has just been made has no earlier choice to keep.
TEST_F(NestedPicture, OfChoicesKeptIsThatOfChoicesMadeAnew) {
    Renderer flown(open_synthetic_terrain(), kSize, nested_options());
    std::uint64_t reused = 0, tested = 0;
    for (std::size_t i = 300; i < 520; ++i) {
        const ig::View& view = eyes[i].eyepoint.view;
        ig::Picture kept = flown.draw_complete(view);
        if (i % 44 != 0) continue;
        const ig::FrameStatistics statistics = flown.draw_now(view, kept);
        reused += statistics.blocks_reused;
        tested += statistics.blocks_tested;
        Renderer fresh(open_synthetic_terrain(), kSize, nested_options());
        EXPECT_EQ(fresh.draw_complete(view).rgba, kept.rgba) << "frame " << i;
    }
    EXPECT_GT(reused, tested / 4);
}

}  // namespace
}  // namespace eyepoint::testing
