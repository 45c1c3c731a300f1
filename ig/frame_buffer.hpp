/// The framebuffer that frames are drawn into, whatever becomes of them.
#pragma once

#include <string>

#include <tl/expected.hpp>

#include "ig/picture.hpp"

namespace eyepoint::ig {

/// Colour (RGBA8, sRGB values stored as they are) and 32-bit float depth, off screen. Owns its GL objects;
/// needs the context that it was made in to be current, at its end too. Thread use: the context's thread.
class FrameBuffer {
  public:
    /// On failure (larger than the driver allows, or out of memory): one sentence.
    [[nodiscard]] static tl::expected<FrameBuffer, std::string> create(PictureSize size);
    ~FrameBuffer();
    FrameBuffer(FrameBuffer&& other) noexcept;
    FrameBuffer& operator=(FrameBuffer&& other) noexcept;

    [[nodiscard]] PictureSize size() const { return size_; }

    /// Binds it for drawing, with the viewport over all of it.
    void bind() const;
    /// The colours as a picture; waits until they are drawn. `picture` is reused storage.
    void read(Picture& picture) const;
    /// Copies the colours to the default framebuffer of the same context, scaled to its size.
    void blit_to_window(PictureSize window) const;

  private:
    explicit FrameBuffer(PictureSize size);

    PictureSize size_;
    unsigned framebuffer_ = 0;
    unsigned colour_ = 0;
    unsigned depth_ = 0;
    bool driver_turns_rows_ = false;  ///< when it is asked to: GL_MESA_pack_invert
};

}  // namespace eyepoint::ig
