#include "net/wire/cigi_message.hpp"

#include <fmt/format.h>

namespace eyepoint::net::wire {
namespace {
constexpr std::size_t kHeaderBytes = 2;
}

std::optional<CigiPacket> CigiPacketWalk::next() {
    if (rest_.empty() || error_) return std::nullopt;
    const std::size_t offset = size_ - rest_.size();
    if (rest_.size() < kHeaderBytes) {
        error_ = WireError{DropReason::BadPacketSize,
                           fmt::format("CIGI message with one odd byte at offset {}", offset)};
        return std::nullopt;
    }
    const auto id = std::to_integer<std::uint8_t>(rest_[0]);
    const auto size = std::to_integer<std::size_t>(rest_[1]);
    if (size < kHeaderBytes || size > rest_.size()) {
        error_ = WireError{DropReason::BadPacketSize,
                           fmt::format("CIGI packet {} at offset {} states {} bytes, {} are left", id, offset,
                                       size, rest_.size())};
        return std::nullopt;
    }
    const CigiPacket packet{id, rest_.first(size)};
    rest_ = rest_.subspan(size);
    return packet;
}

}  // namespace eyepoint::net::wire
