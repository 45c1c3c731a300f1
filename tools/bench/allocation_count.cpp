#include "tools/bench/allocation_count.hpp"

#include <cstdlib>
#include <new>

namespace {
thread_local std::uint64_t allocations = 0;

void* allocate(std::size_t bytes, std::size_t alignment) {
    ++allocations;
    return alignment <= __STDCPP_DEFAULT_NEW_ALIGNMENT__
               ? std::malloc(bytes > 0 ? bytes : 1)
               : std::aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
}

void* required(void* memory) {
    if (memory == nullptr) throw std::bad_alloc();
    return memory;
}
}  // namespace

// The array forms of the standard library call these. The nothrow form stands here because a sanitizer's own
// would not.
void* operator new(std::size_t bytes) { return required(allocate(bytes, 1)); }
void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept { return allocate(bytes, 1); }
void* operator new(std::size_t bytes, std::align_val_t alignment) {
    return required(allocate(bytes, static_cast<std::size_t>(alignment)));
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }

namespace eyepoint::tools {
std::uint64_t heap_allocations() { return allocations; }
}  // namespace eyepoint::tools
