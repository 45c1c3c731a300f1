/// Reading and writing numbers of either byte order at byte offsets, bounds-checked. The only place where
/// bytes of the wire become numbers.
#pragma once

#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>

namespace eyepoint::net::wire {

enum class ByteOrder : std::uint8_t { Big, Little };

/// Reads at offsets from the start of `bytes`. A read that does not lie wholly inside gives 0.
class ByteReader {
  public:
    ByteReader(std::span<const std::byte> bytes, ByteOrder order) : bytes_(bytes), order_(order) {}

    [[nodiscard]] std::uint8_t u8(std::size_t offset) const { return read<std::uint8_t>(offset); }
    [[nodiscard]] std::int8_t i8(std::size_t offset) const { return static_cast<std::int8_t>(u8(offset)); }
    [[nodiscard]] std::uint16_t u16(std::size_t offset) const { return read<std::uint16_t>(offset); }
    [[nodiscard]] std::uint32_t u32(std::size_t offset) const { return read<std::uint32_t>(offset); }
    [[nodiscard]] std::int32_t i32(std::size_t offset) const {
        return std::bit_cast<std::int32_t>(u32(offset));
    }
    [[nodiscard]] float f32(std::size_t offset) const { return std::bit_cast<float>(u32(offset)); }
    [[nodiscard]] double f64(std::size_t offset) const {
        return std::bit_cast<double>(read<std::uint64_t>(offset));
    }
    /// `count` bits of the byte at `offset`, the least significant of them being bit `first`.
    [[nodiscard]] unsigned bits(std::size_t offset, unsigned first, unsigned count) const {
        return (static_cast<unsigned>(u8(offset)) >> first) & ((1U << count) - 1U);
    }
    [[nodiscard]] std::size_t size() const { return bytes_.size(); }

  private:
    template <std::unsigned_integral T>
    [[nodiscard]] T read(std::size_t offset) const {
        if (offset > bytes_.size() || bytes_.size() - offset < sizeof(T)) return 0;
        T value = 0;
        for (std::size_t i = 0; i < sizeof(T); ++i) {
            const std::size_t place = order_ == ByteOrder::Big ? sizeof(T) - 1 - i : i;
            value =
                static_cast<T>(value | static_cast<T>(std::to_integer<T>(bytes_[offset + i]) << (8 * place)));
        }
        return value;
    }

    std::span<const std::byte> bytes_;
    ByteOrder order_;
};

/// Writes at offsets from the start of `bytes`. A write that does not lie wholly inside does nothing.
class ByteWriter {
  public:
    ByteWriter(std::span<std::byte> bytes, ByteOrder order) : bytes_(bytes), order_(order) {}

    void u8(std::size_t offset, std::uint8_t value) const { write(offset, value); }
    void u16(std::size_t offset, std::uint16_t value) const { write(offset, value); }
    void u32(std::size_t offset, std::uint32_t value) const { write(offset, value); }
    void i32(std::size_t offset, std::int32_t value) const {
        u32(offset, std::bit_cast<std::uint32_t>(value));
    }
    void f32(std::size_t offset, float value) const { u32(offset, std::bit_cast<std::uint32_t>(value)); }
    void f64(std::size_t offset, double value) const { write(offset, std::bit_cast<std::uint64_t>(value)); }

  private:
    template <std::unsigned_integral T>
    void write(std::size_t offset, T value) const {
        if (offset > bytes_.size() || bytes_.size() - offset < sizeof(T)) return;
        for (std::size_t i = 0; i < sizeof(T); ++i) {
            const std::size_t place = order_ == ByteOrder::Big ? sizeof(T) - 1 - i : i;
            bytes_[offset + i] = static_cast<std::byte>(value >> (8 * place));
        }
    }

    std::span<std::byte> bytes_;
    ByteOrder order_;
};

}  // namespace eyepoint::net::wire
