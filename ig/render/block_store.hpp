/// Blocks on the graphics card: one vertex buffer of equal slots, the longest unused slot given away first.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "ig/render/gl_objects.hpp"
#include "terrain/block/block.hpp"

namespace eyepoint::ig {

/// Vertex i of a block in slot n is vertex n * kBlockVertices + i of the buffer.
class BlockStore {
  public:
    explicit BlockStore(std::uint32_t slots);

    /// The slot of a block, uploaded if it is not there yet. A slot given out in this frame keeps its block
    /// for the whole frame; when all slots are in use in this frame, the store doubles.
    [[nodiscard]] std::uint32_t slot_of(const terrain::Block& block, std::uint64_t frame);

    [[nodiscard]] GLuint vertex_buffer() const { return vertices_.name(); }
    [[nodiscard]] std::uint32_t slots() const { return static_cast<std::uint32_t>(slots_.size()); }
    /// Blocks uploaded since the store was made.
    [[nodiscard]] std::uint64_t uploads() const { return uploads_; }
    static constexpr std::uint64_t kBytesPerBlock = terrain::kBlockVertices * sizeof(terrain::BlockVertex);

  private:
    struct Slot {
        terrain::TileId tile;
        std::uint64_t used_frame = 0;
        bool occupied = false;
    };
    [[nodiscard]] std::uint32_t free_slot(std::uint64_t frame);
    void grow();

    GlBuffer vertices_;
    std::vector<Slot> slots_;
    std::unordered_map<terrain::TileId, std::uint32_t, terrain::TileHash> slot_by_tile_;
    std::uint64_t uploads_ = 0;
};

}  // namespace eyepoint::ig
