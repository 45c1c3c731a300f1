#include "ig/render/block_store.hpp"

#include <algorithm>

namespace eyepoint::ig {

BlockStore::BlockStore(std::uint32_t slots) : slots_(slots) {
    glNamedBufferStorage(vertices_.name(), static_cast<GLsizeiptr>(slots * kBytesPerBlock), nullptr,
                         GL_DYNAMIC_STORAGE_BIT);
}

std::uint32_t BlockStore::slot_of(const terrain::Block& block, std::uint64_t frame) {
    const terrain::TileId tile = block.data.tile;
    if (const auto found = slot_by_tile_.find(tile); found != slot_by_tile_.end()) {
        slots_[found->second].used_frame = frame;
        return found->second;
    }
    const std::uint32_t slot = free_slot(frame);
    if (slots_[slot].occupied) slot_by_tile_.erase(slots_[slot].tile);
    slots_[slot] = {tile, frame, true};
    slot_by_tile_.emplace(tile, slot);
    glNamedBufferSubData(vertices_.name(), static_cast<GLintptr>(slot * kBytesPerBlock),
                         static_cast<GLsizeiptr>(kBytesPerBlock), block.vertices.data());
    ++uploads_;
    return slot;
}

std::uint32_t BlockStore::free_slot(std::uint64_t frame) {
    const auto age = [](const Slot& slot) { return slot.occupied ? slot.used_frame + 1 : 0; };
    const auto oldest = std::min_element(slots_.begin(), slots_.end(),
                                         [&](const Slot& a, const Slot& b) { return age(a) < age(b); });
    if (oldest->occupied && oldest->used_frame == frame) {
        const auto first_new = static_cast<std::uint32_t>(slots_.size());
        grow();
        return first_new;
    }
    return static_cast<std::uint32_t>(oldest - slots_.begin());
}

void BlockStore::grow() {
    const auto old_bytes = static_cast<GLsizeiptr>(slots_.size() * kBytesPerBlock);
    GlBuffer larger;
    glNamedBufferStorage(larger.name(), old_bytes * 2, nullptr, GL_DYNAMIC_STORAGE_BIT);
    glCopyNamedBufferSubData(vertices_.name(), larger.name(), 0, 0, old_bytes);
    vertices_ = std::move(larger);
    slots_.resize(slots_.size() * 2);
}

}  // namespace eyepoint::ig
