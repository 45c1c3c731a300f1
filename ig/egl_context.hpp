/// An OpenGL context without a display.
#pragma once

#include <memory>
#include <string>

#include <tl/expected.hpp>

#include "ig/gl_identity.hpp"

namespace eyepoint::ig {

/// An OpenGL 4.5 core context without any surface, current on the thread that made it: on EGL's surfaceless
/// platform, or, where that is missing or fails, on the first EGL device that gives one. Draw into
/// framebuffer objects. Thread use: create, use and destroy on one thread.
class EglContext {
  public:
    /// debug: a debug context, for log_gl_messages(). On failure (no EGL library, no driver, no 4.5 core, no
    /// GL_ARB_clip_control): one sentence with the remedy.
    [[nodiscard]] static tl::expected<EglContext, std::string> create(bool debug);
    ~EglContext();
    EglContext(EglContext&&) noexcept;
    EglContext& operator=(EglContext&&) noexcept;

    [[nodiscard]] const GlIdentity& identity() const { return identity_; }

  private:
    struct Handles;
    EglContext(std::unique_ptr<Handles> handles, GlIdentity identity);
    std::unique_ptr<Handles> handles_;
    GlIdentity identity_;
};

}  // namespace eyepoint::ig
