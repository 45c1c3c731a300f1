/// What needs a GL context: run with `ctest -L picture`.
#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include "ig/egl_context.hpp"
#include "ig/frame_buffer.hpp"
#include "ig/gpu_fence.hpp"

namespace eyepoint::ig {
namespace {

TEST(EglContextGl, ComesUpWithoutADisplayAsOpenGl45CoreWithClipControl) {
    const auto context = EglContext::create(false);
    ASSERT_TRUE(context.has_value()) << context.error();
    EXPECT_GE(epoxy_gl_version(), 45);
    EXPECT_TRUE(epoxy_has_gl_extension("GL_ARB_clip_control"));
    EXPECT_FALSE(context->identity().renderer.empty());
    GLint profile = 0;
    glGetIntegerv(GL_CONTEXT_PROFILE_MASK, &profile);
    EXPECT_TRUE(profile & GL_CONTEXT_CORE_PROFILE_BIT);
}

TEST(EglContextGl, CanBeMadeAgainAfterItsEnd) {
    for (int time = 0; time < 3; ++time) EXPECT_TRUE(EglContext::create(false).has_value());
}

TEST(EglContextGl, ADebugContextTellsOfErrors) {
    const auto context = EglContext::create(true);
    ASSERT_TRUE(context.has_value()) << context.error();
    int messages = 0;
    const std::function<void(std::string_view)> log = [&](std::string_view) { ++messages; };
    log_gl_messages(log);
    glEnable(GL_FLOAT);  // no capability
    EXPECT_GE(messages, 1);
}

TEST(FrameBufferGl, IsReadBackWithRowsFromTheTop) {
    const auto context = EglContext::create(false);
    ASSERT_TRUE(context.has_value()) << context.error();
    const auto frame = FrameBuffer::create({31, 17});
    ASSERT_TRUE(frame.has_value()) << frame.error();
    frame->bind();
    glClearColor(0.0F, 0.0F, 1.0F, 1.0F);
    glClear(GL_COLOR_BUFFER_BIT);
    glEnable(GL_SCISSOR_TEST);
    glScissor(30, 16, 1, 1);  // OpenGL counts from the lower left: the upper right pixel
    glClearColor(1.0F, 0.0F, 0.0F, 1.0F);
    glClear(GL_COLOR_BUFFER_BIT);
    ASSERT_TRUE(wait_for_gpu());

    Picture picture;
    frame->read(picture);
    ASSERT_EQ(picture.rgba.size(), 31U * 17U * 4U);
    EXPECT_EQ(picture.rgba[30 * 4], 255);
    EXPECT_EQ(picture.rgba[30 * 4 + 2], 0);
    EXPECT_EQ(picture.rgba[16 * 31 * 4 + 30 * 4], 0);
    EXPECT_EQ(picture.rgba[16 * 31 * 4 + 30 * 4 + 2], 255);
}

TEST(FrameBufferGl, DepthIs32BitFloat) {
    const auto context = EglContext::create(false);
    ASSERT_TRUE(context.has_value()) << context.error();
    const auto frame = FrameBuffer::create({8, 8});
    ASSERT_TRUE(frame.has_value()) << frame.error();
    frame->bind();
    constexpr float kFarAway = 1.0e-7F;  // lost in 24 bits of fixed point
    glClearDepthf(kFarAway);
    glClear(GL_DEPTH_BUFFER_BIT);
    float depth = 0.0F;
    glReadPixels(4, 4, 1, 1, GL_DEPTH_COMPONENT, GL_FLOAT, &depth);
    EXPECT_EQ(depth, kFarAway);
}

TEST(FrameBufferGl, ASizeBeyondTheDriverIsRefusedWithTheRemedy) {
    const auto context = EglContext::create(false);
    ASSERT_TRUE(context.has_value()) << context.error();
    const auto frame = FrameBuffer::create({1 << 20, 16});
    ASSERT_FALSE(frame.has_value());
    EXPECT_NE(frame.error().find("--size"), std::string::npos) << frame.error();
}

}  // namespace
}  // namespace eyepoint::ig
