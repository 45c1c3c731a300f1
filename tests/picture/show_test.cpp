/// The views that show how terrain is drawn.
#include <cstdint>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "tests/picture/flights.hpp"
#include "tests/picture/renderer.hpp"

namespace eyepoint::testing {
namespace {

constexpr ig::PictureSize kSize{480, 270};

const CameraPose kValley{.place = {46.45, 8.2, 2500.0},
                         .yaw_deg = 60.0,
                         .pitch_deg = -8.0,
                         .roll_deg = 0.0,
                         .width_px = kSize.width_px,
                         .height_px = kSize.height_px};

struct Colour {
    int red = 0, green = 0, blue = 0;
    auto operator<=>(const Colour&) const = default;
};

Colour colour_at(const ig::Picture& picture, int x, int y) {
    const auto at = (static_cast<std::size_t>(y) * static_cast<std::size_t>(kSize.width_px) +
                     static_cast<std::size_t>(x)) *
                    ig::Picture::kBytesPerPixel;
    return {picture.rgba[at], picture.rgba[at + 1], picture.rgba[at + 2]};
}

/// Which of the six sextants of the colour circle a colour is in.
int hue_of(const Colour& colour) {
    const auto [r, g, b] = colour;
    return (r >= g ? 1 : 0) + (g >= b ? 2 : 0) + (b >= r ? 4 : 0);
}

DrawnPicture draw(ig::Show show) {
    ig::SceneOptions options;
    options.show = show;
    options.lod_method = "nested";
    Renderer renderer(open_synthetic_terrain(), kSize, options);
    return renderer.draw_complete(kValley);
}

TEST(ShowPicture, LevelsCoverTheTerrainInSeveralHues) {
    const DrawnPicture levels = draw(ig::Show::Levels), terrain = draw(ig::Show::Terrain);
    keep_for_looking(levels.picture, "levels");
    EXPECT_EQ(levels.distance_m, terrain.distance_m);
    const Colour sky = colour_at(levels.picture, 0, 0);
    std::set<int> hues;
    for (int y = 0; y < kSize.height_px; ++y) {
        for (int x = 0; x < kSize.width_px; ++x) {
            const Colour colour = colour_at(levels.picture, x, y);
            ASSERT_EQ(colour == sky, levels.distance_at(x, y) == 0.0) << x << " " << y;
            if (colour != sky) hues.insert(hue_of(colour));
        }
    }
    EXPECT_GE(hues.size(), 3U);
}

TEST(ShowPicture, WireframeIsLinesOnPaper) {
    const DrawnPicture wires = draw(ig::Show::Wireframe);
    keep_for_looking(wires.picture, "wireframe");
    int ink = 0, paper = 0;
    for (int y = 0; y < kSize.height_px; ++y) {
        for (int x = 0; x < kSize.width_px; ++x) {
            if (wires.distance_at(x, y) == 0.0) continue;
            (colour_at(wires.picture, x, y).red < 60 ? ink : paper) += 1;
        }
    }
    EXPECT_GT(ink, kSize.width_px * kSize.height_px / 50);
    EXPECT_GT(paper, ink / 4);
}

}  // namespace
}  // namespace eyepoint::testing
