/// The HUD over a picture: there, readable, and nowhere else.
#include "ig/hud/hud.hpp"

#include <array>
#include <vector>

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include "tests/picture/renderer.hpp"
#include "tests/support/analytic_terrain.hpp"

namespace eyepoint::testing {
namespace {

constexpr ig::PictureSize kSize{640, 400};

const CameraPose kHills{.place = {46.45, 8.2, 2500.0},
                        .yaw_deg = 60.0,
                        .pitch_deg = -8.0,
                        .roll_deg = 0.0,
                        .width_px = kSize.width_px,
                        .height_px = kSize.height_px};

class HudPicture : public ::testing::Test {
  protected:
    HudPicture()
        : renderer_(make_database({.detail_depth = 6}, scratch_.path() / "terrain"), kSize,
                    {.lod_method = "nested", .shading = ig::Shading::Deferred}),
          hud_(ig::Hud::create(kSize).value()) {
        reading_.entry.frame_ms = 12.0;
        reading_.entry.drawn.triangles = 25123;
        reading_.entry.drawn.tau_px = 2.0;
    }

    [[nodiscard]] ig::Picture with_hud() {
        hud_.take(reading_);
        return renderer_.draw_over([&] { hud_.draw(kSize); });
    }

    ScratchFolder scratch_;
    Renderer renderer_;
    ig::Hud hud_;
    ig::HudReading reading_;
};

bool inside(const ig::PictureRectangle& box, int x, int y) {
    return x >= box.left_px && x < box.left_px + box.width_px && y >= box.top_px &&
           y < box.top_px + box.height_px;
}

std::array<int, 3> colour_at(const ig::Picture& picture, int x, int y) {
    const auto at = static_cast<std::size_t>(y * picture.size.width_px + x) * ig::Picture::kBytesPerPixel;
    return {picture.rgba[at], picture.rgba[at + 1], picture.rgba[at + 2]};
}

TEST_F(HudPicture, ChangesItsRectangleAndNothingElse) {
    const ig::Picture without = renderer_.draw_complete(kHills).picture;
    const ig::Picture with = with_hud();
    const ig::PictureRectangle box = hud_.rectangle();
    int changed = 0;
    for (int y = 0; y < kSize.height_px; ++y) {
        for (int x = 0; x < kSize.width_px; ++x) {
            const bool differs = colour_at(with, x, y) != colour_at(without, x, y);
            changed += differs ? 1 : 0;
            ASSERT_TRUE(!differs || inside(box, x, y)) << x << " " << y;
        }
    }
    EXPECT_GT(changed, box.width_px * box.height_px * 95 / 100);
}

/// Light letters: at a fifth of a letter's cell, some 13 lines of 30 letters are thousands of pixels.
TEST_F(HudPicture, ShowsTextInEveryLine) {
    (void)renderer_.draw_complete(kHills);
    const ig::Picture with = with_hud();
    const ig::PictureRectangle box = hud_.rectangle();
    int light = 0;
    for (int y = box.top_px; y < box.top_px + box.height_px; ++y)
        for (int x = box.left_px; x < box.left_px + box.width_px; ++x)
            light += colour_at(with, x, y)[0] > 230 ? 1 : 0;
    EXPECT_GT(light, 2000);
    EXPECT_LT(light, box.width_px * box.height_px / 5);
}

bool is_graph(const std::array<int, 3>& colour) {
    const auto [red, green, blue] = colour;
    return blue > 180 && green > 140 && red < 150;
}

TEST_F(HudPicture, DrawsBothGraphsOverItsWidth) {
    (void)renderer_.draw_complete(kHills);
    for (std::size_t frame = 0; frame < ig::HudHistory::kFrames; ++frame) hud_.take(reading_);
    const ig::Picture with = with_hud();
    const ig::PictureRectangle box = hud_.rectangle();
    keep_for_looking(with, "hud");
    constexpr int kInset = 10;
    for (int x = box.left_px + kInset; x < box.left_px + box.width_px - kInset; ++x) {
        int graphs = 0;
        bool was_graph = false;
        for (int y = box.top_px; y < box.top_px + box.height_px / 2; ++y) {
            const bool graph = is_graph(colour_at(with, x, y));
            graphs += graph && !was_graph ? 1 : 0;
            was_graph = graph;
        }
        ASSERT_EQ(graphs, 2) << x;
    }
}

TEST_F(HudPicture, AnotherFigureIsAnotherPicture) {
    (void)renderer_.draw_complete(kHills);
    const ig::Picture before = with_hud();
    reading_.entry.drawn.triangles = 25124;
    (void)renderer_.draw_complete(kHills);
    EXPECT_NE(with_hud().rgba, before.rgba);
}

TEST_F(HudPicture, FramesAfterItAreAsIfItHadNotBeen) {
    const DrawnPicture before = renderer_.draw_complete(kHills);
    (void)with_hud();
    const DrawnPicture after = renderer_.draw_complete(kHills);
    EXPECT_EQ(after.picture.rgba, before.picture.rgba);
    EXPECT_EQ(after.distance_m, before.distance_m);
}

std::vector<GLint> gl_state() {
    std::vector<GLint> state;
    for (const GLenum what :
         {GL_CURRENT_PROGRAM, GL_VERTEX_ARRAY_BINDING, GL_ARRAY_BUFFER_BINDING, GL_UNIFORM_BUFFER_BINDING,
          GL_ACTIVE_TEXTURE, GL_TEXTURE_BINDING_2D, GL_BLEND, GL_BLEND_SRC_RGB, GL_BLEND_DST_RGB,
          GL_CULL_FACE, GL_DEPTH_TEST, GL_DEPTH_FUNC, GL_DEPTH_WRITEMASK, GL_SCISSOR_TEST, GL_STENCIL_TEST,
          GL_DRAW_FRAMEBUFFER_BINDING, GL_CLIP_ORIGIN, GL_CLIP_DEPTH_MODE, GL_UNPACK_ALIGNMENT}) {
        GLint value = 0;
        glGetIntegerv(what, &value);
        state.push_back(value);
    }
    std::array<GLint, 4> box{};
    for (const GLenum what : {GL_VIEWPORT, GL_SCISSOR_BOX, GL_COLOR_WRITEMASK}) {
        glGetIntegerv(what, box.data());
        state.insert(state.end(), box.begin(), box.end());
    }
    return state;
}

TEST_F(HudPicture, LeavesTheStateOfOpenGlAsItWas) {
    (void)renderer_.draw_complete(kHills);
    std::vector<GLint> before, after;
    hud_.take(reading_);
    (void)renderer_.draw_over([&] {
        before = gl_state();
        hud_.draw(kSize);
        after = gl_state();
    });
    EXPECT_EQ(after, before);
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
}

TEST_F(HudPicture, APictureSmallerThanItShowsAPart) {
    (void)renderer_.draw_complete(kHills);
    hud_.take(reading_);
    (void)renderer_.draw_over([&] { hud_.draw({64, 48}); });
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
}

TEST_F(HudPicture, LettersGrowWithThePicture) {
    const auto large = ig::Hud::create({3840, 2160}).value();
    EXPECT_EQ(large.rectangle().width_px, 3 * hud_.rectangle().width_px);
}

}  // namespace
}  // namespace eyepoint::testing
