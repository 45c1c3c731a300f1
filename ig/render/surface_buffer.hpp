/// Where the raster pass leaves what shading after it needs: four words a pixel (surface.glsl).
#pragma once

#include <cstdint>

#include "ig/render/gl_objects.hpp"

namespace eyepoint::ig {

/// Shares the depth buffer of the framebuffer that the picture is drawn into, so that the shading and the sky
/// are tested against the same depth.
class SurfaceBuffer {
  public:
    /// Makes itself the target, in the size given, with the depth renderbuffer of the framebuffer that is
    /// bound for drawing. False, and nothing is changed, when that has no depth renderbuffer (a window's own
    /// framebuffer).
    [[nodiscard]] bool begin(int width_px, int height_px);
    /// Makes the framebuffer that was bound the target again.
    void end() const;

    [[nodiscard]] GLuint texture() const { return texture_.name(); }

  private:
    void resize(int width_px, int height_px);

    GlFramebuffer framebuffer_;
    GlTexture texture_{GLenum{GL_TEXTURE_2D}};
    int width_px_ = 0;
    int height_px_ = 0;
    GLuint picture_framebuffer_ = 0;
};

}  // namespace eyepoint::ig
