/// Triangles as keys of small tables that forget.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace eyepoint::tools {

/// A triangle by the numbers of its three vertices, in order.
using TriangleKey = std::uint64_t;
inline constexpr TriangleKey kNoTriangle = ~TriangleKey{0};

[[nodiscard]] inline TriangleKey key_of(const std::array<std::uint16_t, 3>& triangle) {
    return triangle[0] | TriangleKey{triangle[1]} << 16U | TriangleKey{triangle[2]} << 32U;
}

inline constexpr unsigned kTrianglePlaceBits = 12;

/// Its place among 2^kTrianglePlaceBits (multiplicative hashing, by 2^64 over the golden ratio).
[[nodiscard]] inline std::size_t place_of(TriangleKey key) {
    return (key * 0x9e3779b97f4a7c15U) >> (64U - kTrianglePlaceBits);
}

}  // namespace eyepoint::tools
