/// Numbers as bytes, least significant first, whatever the machine.
#pragma once

#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace eyepoint::terrain {

template <std::unsigned_integral Number>
void append_le(std::vector<std::uint8_t>& bytes, Number number) {
    for (std::size_t i = 0; i < sizeof(Number); ++i)
        bytes.push_back(static_cast<std::uint8_t>(number >> (8 * i)));
}
/// IEEE 754 binary32.
inline void append_le(std::vector<std::uint8_t>& bytes, float number) {
    append_le(bytes, std::bit_cast<std::uint32_t>(number));
}

/// The caller has checked that bytes holds offset + sizeof(Number) bytes.
template <std::unsigned_integral Number>
[[nodiscard]] Number load_le(std::span<const std::uint8_t> bytes, std::size_t offset) {
    std::uint64_t number = 0;
    for (std::size_t i = 0; i < sizeof(Number); ++i) number |= std::uint64_t{bytes[offset + i]} << (8 * i);
    return static_cast<Number>(number);
}
[[nodiscard]] inline float load_float_le(std::span<const std::uint8_t> bytes, std::size_t offset) {
    return std::bit_cast<float>(load_le<std::uint32_t>(bytes, offset));
}

}  // namespace eyepoint::terrain
