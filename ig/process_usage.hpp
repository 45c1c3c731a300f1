/// What the process has used of the machine so far. Thread use: any.
#pragma once

#include <cstdint>

namespace eyepoint::ig {

/// CPU time of all threads of the process, the graphics driver's included, milliseconds.
[[nodiscard]] double process_cpu_ms();
/// CPU time of the calling thread, milliseconds.
[[nodiscard]] double thread_cpu_ms();
/// Largest resident memory so far, bytes.
[[nodiscard]] std::uint64_t peak_resident_bytes();

}  // namespace eyepoint::ig
