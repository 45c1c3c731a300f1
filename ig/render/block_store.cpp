#include "ig/render/block_store.hpp"

namespace eyepoint::ig {

BlockStore::BlockStore(std::uint32_t slots) : slots_(slots) {
    glNamedBufferStorage(vertices_.name(), static_cast<GLsizeiptr>(slots * kBytesPerBlock), nullptr,
                         GL_DYNAMIC_STORAGE_BIT);
}

std::uint32_t BlockStore::slot_of(const terrain::Block& block, std::uint64_t frame) {
    auto placement = slots_.place(block.data.tile, frame);
    if (!placement) {
        grow();
        placement = slots_.place(block.data.tile, frame);
    }
    if (placement->fresh) {
        glNamedBufferSubData(vertices_.name(), static_cast<GLintptr>(placement->slot * kBytesPerBlock),
                             static_cast<GLsizeiptr>(kBytesPerBlock), block.vertices.data());
        ++uploads_;
    }
    return placement->slot;
}

void BlockStore::grow() {
    const auto old_bytes = static_cast<GLsizeiptr>(slots_.size() * kBytesPerBlock);
    GlBuffer larger;
    glNamedBufferStorage(larger.name(), old_bytes * 2, nullptr, GL_DYNAMIC_STORAGE_BIT);
    glCopyNamedBufferSubData(vertices_.name(), larger.name(), 0, 0, old_bytes);
    vertices_ = std::move(larger);
    slots_.grow_to(slots_.size() * 2);
}

}  // namespace eyepoint::ig
