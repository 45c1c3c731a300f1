#include "ig/frame_buffer.hpp"

#include <algorithm>
#include <utility>

#include <epoxy/gl.h>
#include <fmt/format.h>

namespace eyepoint::ig {

namespace {

constexpr GLuint kWindowFramebuffer = 0;

GLuint make_renderbuffer(GLenum format, PictureSize size) {
    GLuint name = 0;
    glCreateRenderbuffers(1, &name);
    glNamedRenderbufferStorage(name, format, size.width_px, size.height_px);
    return name;
}

/// OpenGL's rows come from the bottom.
void flip_rows(Picture& picture) {
    const auto row_bytes = static_cast<std::ptrdiff_t>(picture.size.width_px) * Picture::kBytesPerPixel;
    for (int row = 0; row < picture.size.height_px / 2; ++row) {
        const auto upper = picture.rgba.begin() + row * row_bytes;
        const auto lower = picture.rgba.begin() + (picture.size.height_px - 1 - row) * row_bytes;
        std::swap_ranges(upper, upper + row_bytes, lower);
    }
}

}  // namespace

tl::expected<FrameBuffer, std::string> FrameBuffer::create(PictureSize size) {
    GLint largest = 0;
    glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &largest);
    if (size.width_px > largest || size.height_px > largest) {
        return tl::unexpected(
            fmt::format("a picture of {}x{} is larger than the {}x{} that the graphics driver draws; "
                        "give a smaller --size",
                        size.width_px, size.height_px, largest, largest));
    }
    FrameBuffer made{size};
    if (glCheckNamedFramebufferStatus(made.framebuffer_, GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
        return tl::unexpected(
            fmt::format("the graphics driver has no memory for a picture of {}x{}; give a smaller "
                        "--size",
                        size.width_px, size.height_px));
    }
    return made;
}

FrameBuffer::FrameBuffer(PictureSize size)
    : size_(size),
      colour_(make_renderbuffer(GL_RGBA8, size)),
      depth_(make_renderbuffer(GL_DEPTH_COMPONENT32F, size)),
      driver_turns_rows_(epoxy_has_gl_extension("GL_MESA_pack_invert")) {
    glCreateFramebuffers(1, &framebuffer_);
    glNamedFramebufferRenderbuffer(framebuffer_, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, colour_);
    glNamedFramebufferRenderbuffer(framebuffer_, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_);
}

FrameBuffer::~FrameBuffer() {
    if (framebuffer_ == 0) return;
    glDeleteFramebuffers(1, &framebuffer_);
    glDeleteRenderbuffers(1, &colour_);
    glDeleteRenderbuffers(1, &depth_);
}

FrameBuffer::FrameBuffer(FrameBuffer&& other) noexcept
    : size_(other.size_),
      framebuffer_(std::exchange(other.framebuffer_, 0)),
      colour_(std::exchange(other.colour_, 0)),
      depth_(std::exchange(other.depth_, 0)),
      driver_turns_rows_(other.driver_turns_rows_) {}

FrameBuffer& FrameBuffer::operator=(FrameBuffer&& other) noexcept {
    std::swap(size_, other.size_);
    std::swap(framebuffer_, other.framebuffer_);
    std::swap(colour_, other.colour_);
    std::swap(depth_, other.depth_);
    std::swap(driver_turns_rows_, other.driver_turns_rows_);
    return *this;
}

void FrameBuffer::bind() const {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    glViewport(0, 0, size_.width_px, size_.height_px);
}

void FrameBuffer::read(Picture& picture) const {
    picture.size = size_;
    picture.rgba.resize(Picture::bytes(size_));
    glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_);
    glPixelStorei(GL_PACK_ALIGNMENT, Picture::kBytesPerPixel);
    if (driver_turns_rows_) glPixelStorei(GL_PACK_INVERT_MESA, GL_TRUE);
    glReadPixels(0, 0, size_.width_px, size_.height_px, GL_RGBA, GL_UNSIGNED_BYTE, picture.rgba.data());
    if (driver_turns_rows_) {
        glPixelStorei(GL_PACK_INVERT_MESA, GL_FALSE);
    } else {
        flip_rows(picture);
    }
}

void FrameBuffer::blit_to_window(PictureSize window) const {
    const GLenum filter = window == size_ ? GL_NEAREST : GL_LINEAR;
    glBlitNamedFramebuffer(framebuffer_, kWindowFramebuffer, 0, 0, size_.width_px, size_.height_px, 0, 0,
                           window.width_px, window.height_px, GL_COLOR_BUFFER_BIT, filter);
}

}  // namespace eyepoint::ig
