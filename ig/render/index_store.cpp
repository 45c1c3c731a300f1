#include "ig/render/index_store.hpp"

namespace eyepoint::ig {

namespace {

constexpr auto bytes(std::size_t indices) { return static_cast<GLsizeiptr>(indices * sizeof(std::uint16_t)); }

}  // namespace

IndexStore::IndexStore(std::uint32_t indices) : ranges_(indices) {
    glNamedBufferStorage(buffer_.name(), bytes(indices), nullptr, GL_DYNAMIC_STORAGE_BIT);
}

std::uint32_t IndexStore::add(std::span<const std::uint16_t> list) {
    const auto count = static_cast<std::uint32_t>(list.size());
    auto first = ranges_.take(count);
    while (!first) {
        grow();
        first = ranges_.take(count);
    }
    if (count > 0) glNamedBufferSubData(buffer_.name(), bytes(*first), bytes(count), list.data());
    return *first;
}

void IndexStore::grow() {
    const std::uint32_t old_size = ranges_.size();
    GlBuffer larger;
    glNamedBufferStorage(larger.name(), bytes(std::size_t{old_size} * 2), nullptr, GL_DYNAMIC_STORAGE_BIT);
    glCopyNamedBufferSubData(buffer_.name(), larger.name(), 0, 0, bytes(old_size));
    buffer_ = std::move(larger);
    ranges_.grow_to(old_size * 2);
}

}  // namespace eyepoint::ig
