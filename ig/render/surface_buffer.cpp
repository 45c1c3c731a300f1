#include "ig/render/surface_buffer.hpp"

namespace eyepoint::ig {

namespace {

GLuint bound_framebuffer() {
    GLint name = 0;
    glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &name);
    return static_cast<GLuint>(name);
}

/// 0: none.
GLuint depth_renderbuffer(GLuint framebuffer) {
    if (framebuffer == 0) return 0;
    GLint type = GL_NONE, name = 0;
    glGetNamedFramebufferAttachmentParameteriv(framebuffer, GL_DEPTH_ATTACHMENT,
                                               GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE, &type);
    if (type != GL_RENDERBUFFER) return 0;
    glGetNamedFramebufferAttachmentParameteriv(framebuffer, GL_DEPTH_ATTACHMENT,
                                               GL_FRAMEBUFFER_ATTACHMENT_OBJECT_NAME, &name);
    return static_cast<GLuint>(name);
}

}  // namespace

bool SurfaceBuffer::begin(int width_px, int height_px) {
    const GLuint picture = bound_framebuffer(), depth = depth_renderbuffer(picture);
    if (depth == 0) return false;
    picture_framebuffer_ = picture;
    if (width_px != width_px_ || height_px != height_px_) resize(width_px, height_px);
    glNamedFramebufferRenderbuffer(framebuffer_.name(), GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer_.name());
    return true;
}

void SurfaceBuffer::end() const { glBindFramebuffer(GL_DRAW_FRAMEBUFFER, picture_framebuffer_); }

void SurfaceBuffer::resize(int width_px, int height_px) {
    texture_ = GlTexture{GLenum{GL_TEXTURE_2D}};
    glTextureStorage2D(texture_.name(), 1, GL_RGBA32UI, width_px, height_px);
    glTextureParameteri(texture_.name(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTextureParameteri(texture_.name(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glNamedFramebufferTexture(framebuffer_.name(), GL_COLOR_ATTACHMENT0, texture_.name(), 0);
    width_px_ = width_px;
    height_px_ = height_px;
}

}  // namespace eyepoint::ig
