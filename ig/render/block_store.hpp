/// Blocks on the graphics card: vertices and relief in buffers of equal slots, and the index lists that
/// blocks have of their own: those of nested meshes, and those that methods make.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "ig/render/gl_objects.hpp"
#include "ig/render/index_store.hpp"
#include "ig/render/slot_table.hpp"
#include "terrain/block/block.hpp"
#include "terrain/lod/lod_method.hpp"

namespace eyepoint::ig {

/// Vertex i of a block in slot n is vertex n * kBlockVertices + i of the buffer.
class BlockStore {
  public:
    explicit BlockStore(std::uint32_t slots);

    /// The slot of a block, good for this frame; uploads the block if it is not there yet. When all slots are
    /// in use in this frame, the store doubles.
    [[nodiscard]] std::uint32_t slot_of(const terrain::Block& block, std::uint64_t frame);
    /// Gives the block in a slot a list that was made for it; uploads it if the block has another one.
    void set_list(std::uint32_t slot, const terrain::BlockMesh& mesh);
    /// Where the index list of the block in a slot begins in index_buffer(), in indices.
    [[nodiscard]] std::uint32_t first_index(std::uint32_t slot) const { return lists_[slot].first; }

    [[nodiscard]] GLuint vertex_buffer() const { return vertices_.name(); }
    /// The vertex buffer as a buffer texture, GL_RGBA32UI: two texels a vertex.
    [[nodiscard]] GLuint vertex_words() const { return vertex_words_.name(); }
    /// terrain::ReliefPost, kBlockVertices a slot, as a buffer texture, GL_R32UI.
    [[nodiscard]] GLuint relief() const { return relief_.name(); }
    [[nodiscard]] GLuint index_buffer() const { return indices_.buffer(); }
    [[nodiscard]] std::uint32_t slots() const { return slots_.size(); }
    /// Since the store was made.
    [[nodiscard]] std::uint64_t uploads() const { return uploads_; }
    [[nodiscard]] std::uint64_t uploaded_bytes() const { return uploaded_bytes_; }

  private:
    struct List {
        std::uint32_t first = 0;
        std::uint32_t count = 0;
        std::uint64_t version = 0;  ///< BlockMesh's; 0: the block's own
    };

    void upload_list(std::uint32_t slot, std::span<const std::uint16_t> indices, std::uint64_t version);
    void upload(const terrain::Block& block, std::uint32_t slot);
    void grow();
    void attach() const;

    GlBuffer vertices_;
    GlTexture vertex_words_;
    GlBuffer relief_posts_;
    GlTexture relief_;
    IndexStore indices_;
    SlotTable slots_;
    std::vector<List> lists_;  ///< by slot
    std::uint64_t uploads_ = 0;
    std::uint64_t uploaded_bytes_ = 0;
};

}  // namespace eyepoint::ig
