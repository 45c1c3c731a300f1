#include "ig/render/block_store.hpp"

namespace eyepoint::ig {

namespace {

constexpr std::uint64_t kBytesPerSlot = terrain::kBlockVertices * sizeof(terrain::BlockVertex);
constexpr std::uint64_t kReliefBytesPerSlot = terrain::kBlockVertices * sizeof(terrain::ReliefPost);
/// The index store's first room, a slot; it grows by need.
constexpr std::uint32_t kFirstIndicesPerSlot = 2048;

/// A buffer with the first bytes of another.
GlBuffer resized(const GlBuffer& from, std::uint64_t kept_bytes, std::uint64_t bytes) {
    GlBuffer to;
    glNamedBufferStorage(to.name(), static_cast<GLsizeiptr>(bytes), nullptr, GL_DYNAMIC_STORAGE_BIT);
    if (kept_bytes > 0)
        glCopyNamedBufferSubData(from.name(), to.name(), 0, 0, static_cast<GLsizeiptr>(kept_bytes));
    return to;
}

}  // namespace

BlockStore::BlockStore(std::uint32_t slots)
    : vertex_words_(GLenum{GL_TEXTURE_BUFFER}),
      relief_(GLenum{GL_TEXTURE_BUFFER}),
      indices_(slots * kFirstIndicesPerSlot),
      slots_(slots),
      lists_(slots) {
    vertices_ = resized(vertices_, 0, slots * kBytesPerSlot);
    relief_posts_ = resized(relief_posts_, 0, slots * kReliefBytesPerSlot);
    attach();
}

void BlockStore::attach() const {
    glTextureBuffer(vertex_words_.name(), GL_RGBA32UI, vertices_.name());
    glTextureBuffer(relief_.name(), GL_R32UI, relief_posts_.name());
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
    constexpr std::uint64_t kReliefBytesPerSlot = terrain::kBlockVertices * sizeof(terrain::ReliefPost);
    glNamedBufferSubData(vertices_.name(), static_cast<GLintptr>(slot * kBytesPerSlot),
                         static_cast<GLsizeiptr>(vertex_bytes), block.vertices.data());
    glNamedBufferSubData(relief_posts_.name(), static_cast<GLintptr>(slot * kReliefBytesPerSlot),
                         static_cast<GLsizeiptr>(kReliefBytesPerSlot), block.relief.data());
    upload_list(slot, block.indices, 0);
    ++uploads_;
    uploaded_bytes_ += vertex_bytes + kReliefBytesPerSlot;
}

void BlockStore::set_list(std::uint32_t slot, const terrain::BlockMesh& mesh) {
    if (lists_[slot].version != mesh.version) upload_list(slot, mesh.indices, mesh.version);
}

void BlockStore::upload_list(std::uint32_t slot, std::span<const std::uint16_t> indices,
                             std::uint64_t version) {
    List& list = lists_[slot];
    indices_.remove(list.first, list.count);
    list = {indices_.add(indices), static_cast<std::uint32_t>(indices.size()), version};
    uploaded_bytes_ += indices.size_bytes();
}

void BlockStore::grow() {
    const std::uint64_t old_slots = slots_.size();
    vertices_ = resized(vertices_, old_slots * kBytesPerSlot, 2 * old_slots * kBytesPerSlot);
    relief_posts_ =
        resized(relief_posts_, old_slots * kReliefBytesPerSlot, 2 * old_slots * kReliefBytesPerSlot);
    attach();
    slots_.grow_to(slots_.size() * 2);
    lists_.resize(slots_.size());
}

}  // namespace eyepoint::ig
