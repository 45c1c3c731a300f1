/// What the process has used of the machine so far. Thread use: any.
#pragma once

#include <cstdint>

namespace eyepoint::ig {

/// CPU time of all threads of the process, the graphics driver's included, milliseconds.
[[nodiscard]] double process_cpu_ms();
/// CPU time of the calling thread, milliseconds.
[[nodiscard]] double thread_cpu_ms();
/// Resident memory now, bytes; 0 where the system does not say.
[[nodiscard]] std::uint64_t resident_bytes();
/// Largest resident memory of this program so far, bytes; 0 where the system does not say.
[[nodiscard]] std::uint64_t peak_resident_bytes();

}  // namespace eyepoint::ig
