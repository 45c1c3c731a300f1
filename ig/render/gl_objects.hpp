/// OpenGL names as values that are owned: made on construction, deleted on destruction, moved, never copied.
/// They need the context that made them current, in the constructor and in the destructor.
#pragma once

#include <utility>

#include <epoxy/gl.h>

namespace eyepoint::ig {

template <typename Traits>
class GlObject {
  public:
    template <typename... Arguments>
    explicit GlObject(Arguments... arguments) : name_(Traits::create(arguments...)) {}
    ~GlObject() {
        if (name_ != 0) Traits::destroy(name_);
    }
    GlObject(GlObject&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
    GlObject& operator=(GlObject&& other) noexcept {
        std::swap(name_, other.name_);
        return *this;
    }
    [[nodiscard]] GLuint name() const { return name_; }

  private:
    GLuint name_ = 0;
};

struct BufferTraits {
    static GLuint create() {
        GLuint name = 0;
        glCreateBuffers(1, &name);
        return name;
    }
    static void destroy(GLuint name) { glDeleteBuffers(1, &name); }
};
struct VertexArrayTraits {
    static GLuint create() {
        GLuint name = 0;
        glCreateVertexArrays(1, &name);
        return name;
    }
    static void destroy(GLuint name) { glDeleteVertexArrays(1, &name); }
};
struct TextureTraits {
    static GLuint create(GLenum target) {
        GLuint name = 0;
        glCreateTextures(target, 1, &name);
        return name;
    }
    static void destroy(GLuint name) { glDeleteTextures(1, &name); }
};
struct FramebufferTraits {
    static GLuint create() {
        GLuint name = 0;
        glCreateFramebuffers(1, &name);
        return name;
    }
    static void destroy(GLuint name) { glDeleteFramebuffers(1, &name); }
};
struct ProgramTraits {
    static GLuint create() { return glCreateProgram(); }
    static void destroy(GLuint name) { glDeleteProgram(name); }
};
struct ShaderTraits {
    static GLuint create(GLenum stage) { return glCreateShader(stage); }
    static void destroy(GLuint name) { glDeleteShader(name); }
};

using GlBuffer = GlObject<BufferTraits>;
using GlVertexArray = GlObject<VertexArrayTraits>;
using GlTexture = GlObject<TextureTraits>;
using GlFramebuffer = GlObject<FramebufferTraits>;
using GlProgram = GlObject<ProgramTraits>;
using GlShader = GlObject<ShaderTraits>;

}  // namespace eyepoint::ig
