/// The unit of time stamps: nanoseconds.
#pragma once

#include <cstdint>

namespace eyepoint::net {

inline constexpr std::int64_t kNanosecondsPerSecond = 1'000'000'000;
inline constexpr double kSecondsPerNanosecond = 1e-9;

}  // namespace eyepoint::net
