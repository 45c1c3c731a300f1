// The first bytes of each protocol and version: docs/protocols.md, "Telling them apart".
#include "net/wire/protocol_of.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "net/wire/byte_order.hpp"
#include "net/wire/cigi_message.hpp"
#include "net/wire/cigi_packets.hpp"

namespace eyepoint::net::wire {
namespace {

constexpr std::size_t kShortestDatagram = 8;
constexpr auto kIgControlId = static_cast<std::uint8_t>(CigiPacketId::IgControl);
constexpr auto kStartOfFrameId = static_cast<std::uint8_t>(CigiPacketId::StartOfFrame);
// Versions of FlightGear's native packets are small numbers; CIGI and text never begin with three zero bytes.
constexpr std::uint32_t kHighestNativeVersion = 99;

// CIGI 4's first packet is 24 bytes long, written as a 16-bit size before a 16-bit id of 0 (host) or 0xffff
// (IG).
bool is_cigi4(const ByteReader& reader) {
    const bool size_24 = reader.u16(0) == 0x1800 || reader.u16(0) == 0x0018;
    const std::uint16_t id = reader.u16(2);
    return size_24 && (id == 0x0000 || id == 0xffff) && reader.u8(4) == 4;
}

bool has_ig_control_later(std::span<const std::byte> datagram) {
    CigiPacketWalk walk(datagram);
    bool found = false;
    while (const auto packet = walk.next()) {
        found = found || (packet->id == kIgControlId && packet->bytes.size() >= kShortIgControlBytes &&
                          packet->bytes[2] == std::byte{3});
    }
    return found && !walk.error();
}

std::string first_bytes(std::span<const std::byte> datagram) {
    std::string text;
    for (const std::byte byte : datagram.first(std::min<std::size_t>(datagram.size(), 8))) {
        text += fmt::format("{:02x} ", std::to_integer<unsigned>(byte));
    }
    return text;
}

tl::unexpected<WireError> refuse(DropReason reason, std::string detail) {
    return tl::unexpected(WireError{reason, std::move(detail)});
}

}  // namespace

tl::expected<Protocol, WireError> protocol_of(std::span<const std::byte> datagram) {
    if (datagram.size() < kShortestDatagram) {
        return refuse(DropReason::Short,
                      fmt::format("datagram of {} bytes, too short for any protocol", datagram.size()));
    }
    const ByteReader reader(datagram, ByteOrder::Big);
    if (is_cigi4(reader)) {
        return refuse(DropReason::WrongVersion, "CIGI 4.0 is not supported: set the host to CIGI 3.3");
    }
    const std::uint32_t version = reader.u32(0);
    const bool swapped_fdm = version == 0x18000000U || version == 0x19000000U;
    if (swapped_fdm || (version >= 1 && version <= kHighestNativeVersion)) return Protocol::FgNetFdm;

    const std::uint8_t id = reader.u8(0), major = reader.u8(2);
    if (id == kIgControlId && (major == 1 || major == 2)) {
        return refuse(DropReason::WrongVersion,
                      fmt::format("CIGI {} is not supported: set the host to CIGI 3.3", major));
    }
    if (id == kIgControlId && major == 3) return Protocol::Cigi;
    if (id == kStartOfFrameId && major == 3) {
        return refuse(DropReason::MisplacedIgControl,
                      "CIGI Start Of Frame: this comes from an image generator, not from a host");
    }
    if (has_ig_control_later(datagram)) {
        return refuse(DropReason::MisplacedIgControl,
                      fmt::format("CIGI message that begins with packet {}, expected IG Control (1)", id));
    }
    return refuse(DropReason::UnknownProtocol,
                  fmt::format("{} bytes that begin with {}are neither FGNetFDM nor CIGI 3", datagram.size(),
                              first_bytes(datagram)));
}

}  // namespace eyepoint::net::wire
