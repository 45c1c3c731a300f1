/// Bytes for tests: from hex, in heap buffers of exact size, and whole CIGI messages in either byte order.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "net/wire/byte_order.hpp"

namespace eyepoint::net::testing {

using Bytes = std::vector<std::byte>;

inline Bytes from_hex(std::string_view hex) {
    const auto digit = [](char c) { return c <= '9' ? c - '0' : c - 'a' + 10; };
    Bytes bytes;
    for (std::size_t i = 0; i + 1 < hex.size(); i += 2) {
        bytes.push_back(static_cast<std::byte>(digit(hex[i]) * 16 + digit(hex[i + 1])));
    }
    return bytes;
}

/// A copy in an allocation of exactly its size, so that AddressSanitizer sees a read of one byte too many.
class ExactCopy {
  public:
    explicit ExactCopy(std::span<const std::byte> bytes) : bytes_(bytes.begin(), bytes.end()) {}
    /// Of the first `size` bytes.
    ExactCopy(std::span<const std::byte> bytes, std::size_t size) : ExactCopy(bytes.first(size)) {}
    [[nodiscard]] std::span<const std::byte> span() const { return bytes_; }

  private:
    std::vector<std::byte> bytes_;  ///< copied from a pair of iterators: no capacity to spare
};

inline Bytes operator+(Bytes a, const Bytes& b) {
    for (const std::byte byte : b) a.push_back(byte);
    return a;
}

struct IgControlFields {
    std::uint8_t size = 24;
    std::uint8_t mode = 1;
    std::int8_t database = 0;
    std::uint32_t host_frame = 1;
    std::uint32_t timestamp_10us = 0;
};
inline Bytes ig_control(const IgControlFields& fields, wire::ByteOrder order = wire::ByteOrder::Little) {
    Bytes bytes(fields.size);
    const wire::ByteWriter writer(bytes, order);
    writer.u8(0, 1);
    writer.u8(1, fields.size);
    writer.u8(2, 3);
    writer.u8(3, static_cast<std::uint8_t>(fields.database));
    writer.u8(4, static_cast<std::uint8_t>(fields.mode | 4U));
    writer.u16(6, 0x8000);
    writer.u32(8, fields.host_frame);
    writer.u32(12, fields.timestamp_10us);
    return bytes;
}

struct EntityFields {
    std::uint16_t id = 0;
    std::uint8_t flags = 1;  ///< state in bits 0-1, attach in bit 2, clamp in bits 5-6
    float roll = 0, pitch = 0, yaw = 0;
    double latitude = 46.0, longitude = 8.0, altitude = 3000.0;
};
inline Bytes entity_control(const EntityFields& fields, wire::ByteOrder order = wire::ByteOrder::Little) {
    Bytes bytes(48);
    const wire::ByteWriter writer(bytes, order);
    writer.u8(0, 2);
    writer.u8(1, 48);
    writer.u16(2, fields.id);
    writer.u8(4, fields.flags);
    writer.f32(12, fields.roll);
    writer.f32(16, fields.pitch);
    writer.f32(20, fields.yaw);
    writer.f64(24, fields.latitude);
    writer.f64(32, fields.longitude);
    writer.f64(40, fields.altitude);
    return bytes;
}

struct RateFields {
    std::uint16_t id = 0;
    std::uint8_t flags = 0;           ///< of a part in bit 0, body axes in bit 1
    float v[6] = {0, 0, 0, 0, 0, 0};  ///< x y z roll pitch yaw
};
inline Bytes rate_control(const RateFields& fields, wire::ByteOrder order = wire::ByteOrder::Little) {
    Bytes bytes(32);
    const wire::ByteWriter writer(bytes, order);
    writer.u8(0, 8);
    writer.u8(1, 32);
    writer.u16(2, fields.id);
    writer.u8(5, fields.flags);
    for (std::size_t i = 0; i < 6; ++i) writer.f32(8 + 4 * i, fields.v[i]);
    return bytes;
}

struct ViewFields {
    std::uint16_t view = 0;
    std::uint8_t group = 0;
    std::uint8_t enables = 0x3f;
    std::uint16_t entity = 0;         ///< View Control only
    float v[6] = {0, 0, 0, 0, 0, 0};  ///< x y z roll pitch yaw, or near far left right top bottom
};
inline Bytes view_control(const ViewFields& fields, wire::ByteOrder order = wire::ByteOrder::Little) {
    Bytes bytes(32);
    const wire::ByteWriter writer(bytes, order);
    writer.u8(0, 16);
    writer.u8(1, 32);
    writer.u16(2, fields.view);
    writer.u8(4, fields.group);
    writer.u8(5, fields.enables);
    writer.u16(6, fields.entity);
    for (std::size_t i = 0; i < 6; ++i) writer.f32(8 + 4 * i, fields.v[i]);
    return bytes;
}
inline Bytes view_definition(const ViewFields& fields, wire::ByteOrder order = wire::ByteOrder::Little) {
    Bytes bytes = view_control(fields, order);
    bytes[0] = std::byte{21};
    bytes[6] = bytes[7] = std::byte{0};
    return bytes;
}

}  // namespace eyepoint::net::testing
