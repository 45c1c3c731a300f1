/// Index lists of blocks on the graphics card: one buffer of ranges of any length.
#pragma once

#include <cstdint>
#include <span>

#include "ig/render/gl_objects.hpp"
#include "ig/render/range_allocator.hpp"

namespace eyepoint::ig {

class IndexStore {
  public:
    explicit IndexStore(std::uint32_t indices);

    /// Uploads a list and returns where it begins, in indices. The store doubles, copying, until it has room;
    /// lists stay where they are in it, but the buffer is another one.
    [[nodiscard]] std::uint32_t add(std::span<const std::uint16_t> list);
    void remove(std::uint32_t first, std::uint32_t count) { ranges_.give_back(first, count); }

    [[nodiscard]] GLuint buffer() const { return buffer_.name(); }

  private:
    void grow();

    GlBuffer buffer_;
    RangeAllocator ranges_;
};

}  // namespace eyepoint::ig
