/// Small numbers as streams of bytes, and a reader that any bytes may be given.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "terrain/database/little_endian.hpp"

namespace eyepoint::terrain {

/// 0, -1, 1, -2 ... (two's complement) as 0, 1, 2, 3.
[[nodiscard]] constexpr std::uint32_t zigzag(std::uint32_t value) {
    return (value << 1) ^ (value >> 31 != 0 ? 0xFFFFFFFFU : 0U);
}
[[nodiscard]] constexpr std::uint32_t unzigzag(std::uint32_t value) {
    return (value >> 1) ^ (0U - (value & 1U));
}

/// A byte that says that the number is elsewhere or goes on.
inline constexpr std::uint8_t kEscape = 255;

/// A number, mostly small, as a sum of bytes of which all but the last are kEscape.
inline void append_sum(std::vector<std::uint8_t>& bytes, std::size_t number) {
    for (; number >= kEscape; number -= kEscape) bytes.push_back(kEscape);
    bytes.push_back(static_cast<std::uint8_t>(number));
}

/// A number in groups of seven bits, least significant first; the high bit says that another follows.
inline void append_varint(std::vector<std::uint8_t>& bytes, std::uint64_t number) {
    for (; number >= 128; number >>= 7) bytes.push_back(static_cast<std::uint8_t>(number | 128));
    bytes.push_back(static_cast<std::uint8_t>(number));
}

/// Reads from the front. Where the bytes do not suffice it gives empty spans and zeros, and failed() is true
/// from then on.
class ByteReader {
  public:
    explicit ByteReader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

    std::span<const std::uint8_t> take(std::size_t count) {
        failed_ = failed_ || count > bytes_.size();
        if (failed_) return {};
        const auto taken = bytes_.first(count);
        bytes_ = bytes_.subspan(count);
        return taken;
    }
    template <std::unsigned_integral Number>
    Number number() {
        const auto bytes = take(sizeof(Number));
        return failed_ ? Number{0} : load_le<Number>(bytes, 0);
    }
    /// See append_sum.
    std::size_t sum() {
        std::size_t result = 0;
        while (true) {
            const auto part = number<std::uint8_t>();
            result += part;
            if (part != kEscape) return result;
        }
    }
    /// See append_varint; modulo 2^63.
    std::uint64_t varint() {
        std::uint64_t result = 0;
        for (int shift = 0; shift < 63; shift += 7) {
            const auto part = number<std::uint8_t>();
            result |= std::uint64_t{part & 127U} << shift;
            if (part < 128) break;
        }
        return result;
    }
    std::span<const std::uint8_t> rest() { return take(bytes_.size()); }
    [[nodiscard]] bool failed() const { return failed_; }

  private:
    std::span<const std::uint8_t> bytes_;
    bool failed_ = false;
};

}  // namespace eyepoint::terrain
