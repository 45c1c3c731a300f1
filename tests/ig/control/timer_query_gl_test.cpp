/// Timer queries against a fence on the OpenGL that is here.
#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include "ig/control/timer_query_check.hpp"
#include "ig/egl_context.hpp"
#include "ig/frame_buffer.hpp"

namespace eyepoint::ig {
namespace {

GLuint shader(GLenum kind, const char* text) {
    const GLuint name = glCreateShader(kind);
    glShaderSource(name, 1, &text, nullptr);
    glCompileShader(name);
    return name;
}

/// Fills the picture, with some hundred sines a pixel.
GLuint heavy_program() {
    const GLuint program = glCreateProgram();
    glAttachShader(program, shader(GL_VERTEX_SHADER, R"(#version 450 core
void main() { gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0); })"));
    glAttachShader(program, shader(GL_FRAGMENT_SHADER, R"(#version 450 core
out vec4 colour;
void main() {
    float sum = gl_FragCoord.x;
    for (int i = 0; i < 200; ++i) sum = sin(sum + gl_FragCoord.y);
    colour = vec4(sum);
})"));
    glLinkProgram(program);
    return program;
}

TEST(TimerQueriesGl, AreNotBelievedWhereTheySeeAFractionOfTheWork) {
    const auto context = EglContext::create(false);
    ASSERT_TRUE(context.has_value()) << context.error();
    const auto frame = FrameBuffer::create({640, 640});
    ASSERT_TRUE(frame.has_value()) << frame.error();
    frame->bind();
    const GLuint program = heavy_program();
    GLuint layout = 0;
    glCreateVertexArrays(1, &layout);
    glBindVertexArray(layout);
    glUseProgram(program);
    const auto check = check_timer_queries([] { glDrawArrays(GL_TRIANGLES, 0, 3); });
    glDeleteVertexArrays(1, &layout);
    glDeleteProgram(program);
    ASSERT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
    if (!check) GTEST_SKIP() << "no timer queries here";
    EXPECT_GT(check->fence_ms, 0.0);
    EXPECT_EQ(check->agrees, timers_agree(check->query_ms, check->fence_ms)) << describe(check);
    const bool software = context->identity().renderer.find("llvmpipe") != std::string::npos;
    EXPECT_FALSE(software && check->agrees) << describe(check);
}

}  // namespace
}  // namespace eyepoint::ig
