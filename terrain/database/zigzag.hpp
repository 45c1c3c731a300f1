/// Signed numbers as unsigned ones, those near 0 small.
#pragma once

#include <cstdint>

namespace eyepoint::terrain {

/// 0, -1, 1, -2 ... (two's complement) as 0, 1, 2, 3.
[[nodiscard]] constexpr std::uint32_t zigzag(std::uint32_t value) {
    return (value << 1) ^ (value >> 31 != 0 ? 0xFFFFFFFFU : 0U);
}
[[nodiscard]] constexpr std::uint32_t unzigzag(std::uint32_t value) {
    return (value >> 1) ^ (0U - (value & 1U));
}

}  // namespace eyepoint::terrain
