/// The program's own operator new counts.
#pragma once

#include <cstdint>

namespace eyepoint::tools {

/// Heap allocations of the calling thread since it began.
[[nodiscard]] std::uint64_t heap_allocations();

}  // namespace eyepoint::tools
