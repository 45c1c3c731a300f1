#include "ig/render/block_store.hpp"

namespace eyepoint::ig {

namespace {

constexpr std::uint64_t kBytesPerSlot = terrain::kBlockVertices * sizeof(terrain::BlockVertex);
/// The index store's first room, a slot; it grows by need.
constexpr std::uint32_t kFirstIndicesPerSlot = 2048;

}  // namespace

BlockStore::BlockStore(std::uint32_t slots)
    : vertex_words_(GLenum{GL_TEXTURE_BUFFER}),
      indices_(slots * kFirstIndicesPerSlot),
      slots_(slots),
      lists_(slots) {
    glNamedBufferStorage(vertices_.name(), static_cast<GLsizeiptr>(slots * kBytesPerSlot), nullptr,
                         GL_DYNAMIC_STORAGE_BIT);
    glTextureBuffer(vertex_words_.name(), GL_RG32UI, vertices_.name());
}

std::uint32_t BlockStore::slot_of(const terrain::Block& block, std::uint64_t frame) {
    auto placement = slots_.place(block.data.tile, frame);
    if (!placement) {
        grow();
        placement = slots_.place(block.data.tile, frame);
    }
    if (placement->fresh) upload(block, placement->slot);
    return placement->slot;
}

void BlockStore::upload(const terrain::Block& block, std::uint32_t slot) {
    const std::size_t vertex_bytes = block.vertices.size() * sizeof(terrain::BlockVertex);
    glNamedBufferSubData(vertices_.name(), static_cast<GLintptr>(slot * kBytesPerSlot),
                         static_cast<GLsizeiptr>(vertex_bytes), block.vertices.data());
    List& list = lists_[slot];
    indices_.remove(list.first, list.count);
    list = {indices_.add(block.indices), static_cast<std::uint32_t>(block.indices.size())};
    ++uploads_;
    uploaded_bytes_ += vertex_bytes + block.indices.size() * sizeof(std::uint16_t);
}

void BlockStore::grow() {
    const auto old_bytes = static_cast<GLsizeiptr>(slots_.size() * kBytesPerSlot);
    GlBuffer larger;
    glNamedBufferStorage(larger.name(), old_bytes * 2, nullptr, GL_DYNAMIC_STORAGE_BIT);
    glCopyNamedBufferSubData(vertices_.name(), larger.name(), 0, 0, old_bytes);
    vertices_ = std::move(larger);
    glTextureBuffer(vertex_words_.name(), GL_RG32UI, vertices_.name());
    slots_.grow_to(slots_.size() * 2);
    lists_.resize(slots_.size());
}

}  // namespace eyepoint::ig
