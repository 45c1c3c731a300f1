/// Pictures by the nested method do not depend on what was drawn before: a still eye's are the same bits, and
/// so are those of choices kept from earlier frames and of choices made anew.
#include <algorithm>
#include <cstdlib>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/picture/flights.hpp"
#include "tests/picture/renderer.hpp"

namespace eyepoint::testing {
namespace {

/// Between two pictures of one view.
struct Difference {
    std::size_t pixels_moved = 0;    ///< whose surface is not at the same distance
    std::size_t pixels_painted = 0;  ///< that have not the same colour
    int most = 0;                    ///< of a channel, 0..255
};

Difference difference(const DrawnPicture& a, const DrawnPicture& b) {
    // Depths are interpolated from another corner where a triangle is listed with another corner first.
    constexpr double kRounding = 1e-4;
    Difference result;
    for (std::size_t i = 0; i < a.distance_m.size(); ++i)
        if (std::abs(a.distance_m[i] - b.distance_m[i]) > kRounding * a.distance_m[i]) ++result.pixels_moved;
    for (std::size_t i = 0; i < a.picture.rgba.size(); i += ig::Picture::kBytesPerPixel) {
        int apart = 0;
        for (std::size_t channel = 0; channel < 3; ++channel)
            apart = std::max(apart, std::abs(a.picture.rgba[i + channel] - b.picture.rgba[i + channel]));
        result.pixels_painted += apart > 0 ? 1 : 0;
        result.most = std::max(result.most, apart);
    }
    return result;
}

DrawnPicture draw_loaded(Renderer& renderer, const ig::View& view) {
    (void)renderer.draw_complete(view);
    return renderer.draw_distances(view);
}

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

/// The surface is the same. Its colours may differ by a few steps at a few pixels where a block is drawn in
/// place of its children or they in its: heights for shading are rounded in each, and a block without water
/// of its own does not paint that of a vertex that has slid to an ancestor's.
void expect_same_surface(const DrawnPicture& a, const DrawnPicture& b, const std::string& when) {
    constexpr std::size_t kFewPixels = 40;
    constexpr int kFewSteps = 8;
    const Difference apart = difference(a, b);
    EXPECT_EQ(apart.pixels_moved, 0U) << when;
    EXPECT_LE(apart.pixels_painted, kFewPixels) << when;
    EXPECT_LE(apart.most, kFewSteps) << when;
}

/// The eye comes from afar, so that choices of many ages stand, wanders until others are made, and is back.
TEST_F(NestedPicture, OfAStillEyeIsTheSameAlsoWhileChoicesExpire) {
    Renderer renderer(open_synthetic_terrain(), kSize, nested_options());
    constexpr std::size_t kHere = 600, kRound = 90;
    for (std::size_t i = 0; i <= kHere; i += 10) (void)renderer.draw_complete(eyes[i].eyepoint.view);
    const ig::View& here = eyes[kHere].eyepoint.view;
    const DrawnPicture first = draw_loaded(renderer, here);
    keep_for_looking(first.picture, "nested-still");
    ig::Picture again;
    for (int frame = 0; frame < 5; ++frame) {
        (void)renderer.draw_now(here, again);
        EXPECT_TRUE(first.picture.rgba == again.rgba) << "still, frame " << frame;
    }
    for (std::size_t away = 10; away <= kRound; away += 20) {
        (void)renderer.draw_complete(eyes[kHere + away].eyepoint.view);
        expect_same_surface(first, draw_loaded(renderer, here),
                            "back from " + std::to_string(away) + " frames ahead");
    }
}

/// A scene that has just been made has no earlier choice to keep.
TEST_F(NestedPicture, OfChoicesKeptIsThatOfChoicesMadeAnew) {
    constexpr std::size_t kFrom = 300, kUntil = 520, kStep = 44;
    std::vector<DrawnPicture> kept;
    std::uint64_t reused = 0, tested = 0;
    {
        Renderer flown(open_synthetic_terrain(), kSize, nested_options());
        for (std::size_t i = kFrom; i < kUntil; i += 4) {
            const ig::View& view = eyes[i].eyepoint.view;
            DrawnPicture drawn = draw_loaded(flown, view);
            if (i % kStep != 0) continue;
            reused += drawn.statistics.blocks_reused;
            tested += drawn.statistics.blocks_tested;
            kept.push_back(std::move(drawn));
        }
    }
    EXPECT_GT(reused, tested / 4);
    for (std::size_t i = kFrom, frame = 0; i < kUntil; ++i) {
        if (i % kStep != 0) continue;
        Renderer fresh(open_synthetic_terrain(), kSize, nested_options());
        const DrawnPicture anew = draw_loaded(fresh, eyes[i].eyepoint.view);
        keep_for_looking(anew.picture, "nested-anew-" + std::to_string(i));
        keep_for_looking(kept[frame].picture, "nested-kept-" + std::to_string(i));
        expect_same_surface(anew, kept[frame], "frame " + std::to_string(i));
        ++frame;
    }
}

}  // namespace
}  // namespace eyepoint::testing
