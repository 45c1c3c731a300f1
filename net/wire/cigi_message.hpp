/// A CIGI 3 message as a row of packets: which one comes next, by the size that each states.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include <tl/expected.hpp>

#include "net/drop_reason.hpp"

namespace eyepoint::net::wire {

struct CigiPacket {
    std::uint8_t id = 0;
    std::span<const std::byte> bytes;  ///< with its two-byte header
};

/// Steps through a datagram. Copies nothing; `message` has to outlive it.
///
///     CigiPacketWalk walk(message);
///     while (const auto packet = walk.next()) ...
///     if (walk.error()) ...   // what is left cannot be walked; the packets before it stand
class CigiPacketWalk {
  public:
    explicit CigiPacketWalk(std::span<const std::byte> message) : rest_(message), size_(message.size()) {}

    /// The next packet; nullopt at the end, and where the stated size is less than a header or runs past the
    /// end.
    [[nodiscard]] std::optional<CigiPacket> next();
    [[nodiscard]] const std::optional<WireError>& error() const { return error_; }

  private:
    std::span<const std::byte> rest_;
    std::size_t size_;
    std::optional<WireError> error_;
};

}  // namespace eyepoint::net::wire
