/// Blocks on the graphics card: one vertex buffer of equal slots.
#pragma once

#include <cstdint>

#include "ig/render/gl_objects.hpp"
#include "ig/render/slot_table.hpp"
#include "terrain/block/block.hpp"

namespace eyepoint::ig {

/// Vertex i of a block in slot n is vertex n * kBlockVertices + i of the buffer.
class BlockStore {
  public:
    explicit BlockStore(std::uint32_t slots);

    /// The slot of a block, good for this frame; uploads the block if it is not there yet. When all slots are
    /// in use in this frame, the store doubles.
    [[nodiscard]] std::uint32_t slot_of(const terrain::Block& block, std::uint64_t frame);

    [[nodiscard]] GLuint vertex_buffer() const { return vertices_.name(); }
    [[nodiscard]] std::uint32_t slots() const { return slots_.size(); }
    /// Blocks uploaded since the store was made.
    [[nodiscard]] std::uint64_t uploads() const { return uploads_; }
    static constexpr std::uint64_t kBytesPerBlock = terrain::kBlockVertices * sizeof(terrain::BlockVertex);

  private:
    void grow();

    GlBuffer vertices_;
    SlotTable slots_;
    std::uint64_t uploads_ = 0;
};

}  // namespace eyepoint::ig
