// Header layouts: IEEE 802.3 and 802.1Q, RFC 791 (IPv4), RFC 8200 (IPv6), RFC 768 (UDP), and the link-layer
// header types of tcpdump.org for Linux cooked captures and BSD loopback.
#include "net/udp_datagram.hpp"

#include <algorithm>

#include "net/wire/byte_order.hpp"

namespace eyepoint::net {
namespace {

using wire::ByteOrder;
using wire::ByteReader;
using wire::ByteWriter;
using Kind = FrameContent::Kind;

constexpr std::uint16_t kEtherIpv4 = 0x0800, kEtherIpv6 = 0x86dd, kEtherVlan = 0x8100,
                        kEtherProviderVlan = 0x88a8;
constexpr std::uint8_t kProtocolUdp = 17;
constexpr std::size_t kEthernetBytes = 14, kIpv4Bytes = 20, kIpv6Bytes = 40, kUdpBytes = 8;

// Where the network layer begins, and that it is IP; nullopt where it is not.
std::optional<std::size_t> network_offset(const ByteReader& frame, LinkLayer link_layer) {
    const auto ip_after = [&](std::size_t type_offset, std::size_t header) -> std::optional<std::size_t> {
        const std::uint16_t type = frame.u16(type_offset);
        return type == kEtherIpv4 || type == kEtherIpv6 ? std::optional(header) : std::nullopt;
    };
    switch (link_layer) {
        case LinkLayer::Ethernet: {
            std::size_t type = 12;
            while (frame.u16(type) == kEtherVlan || frame.u16(type) == kEtherProviderVlan) type += 4;
            return ip_after(type, type + 2);
        }
        case LinkLayer::LinuxCooked:
            return ip_after(14, 16);
        case LinkLayer::LinuxCooked2:
            return ip_after(0, 20);
        case LinkLayer::RawIp:
            return 0;
        // The address family in the order of the capturing machine; the IP version says it all the same.
        case LinkLayer::BsdLoopback:
            return 4;
    }
    return std::nullopt;
}

FrameContent look_into_udp(std::span<const std::byte> bytes, UdpView udp) {
    const ByteReader reader(bytes, ByteOrder::Big);
    const std::size_t length = reader.u16(4);
    if (bytes.size() < kUdpBytes || length < kUdpBytes || length > bytes.size()) return {};
    udp.source_port = reader.u16(0);
    udp.destination_port = reader.u16(2);
    udp.payload = bytes.subspan(kUdpBytes, length - kUdpBytes);
    return {Kind::Udp, udp};
}

std::array<std::uint8_t, 4> address_at(const ByteReader& reader, std::size_t offset) {
    return {reader.u8(offset), reader.u8(offset + 1), reader.u8(offset + 2), reader.u8(offset + 3)};
}

FrameContent look_into_ipv4(std::span<const std::byte> packet) {
    const ByteReader reader(packet, ByteOrder::Big);
    const std::size_t header = 4UL * reader.bits(0, 0, 4);
    const std::size_t total = reader.u16(2);
    if (header < kIpv4Bytes || total < header || total > packet.size()) return {};
    constexpr std::uint16_t kMoreFragmentsAndOffset = 0x3fff;
    if ((reader.u16(6) & kMoreFragmentsAndOffset) != 0) return {Kind::Fragment, {}};
    if (reader.u8(9) != kProtocolUdp) return {};
    UdpView udp;
    udp.source_address = address_at(reader, 12);
    udp.destination_address = address_at(reader, 16);
    return look_into_udp(packet.subspan(header, total - header), udp);
}

FrameContent look_into_ipv6(std::span<const std::byte> packet) {
    constexpr std::uint8_t kHopByHop = 0, kRouting = 43, kFragment = 44, kDestination = 60;
    const ByteReader reader(packet, ByteOrder::Big);
    const std::size_t total = kIpv6Bytes + reader.u16(4);
    if (total > packet.size()) return {};
    std::uint8_t next = reader.u8(6);
    std::size_t offset = kIpv6Bytes;
    while ((next == kHopByHop || next == kRouting || next == kDestination) && offset + 2 <= total) {
        next = reader.u8(offset);
        offset += 8UL * (reader.u8(offset + 1) + 1UL);
    }
    if (next == kFragment) return {Kind::Fragment, {}};
    if (next != kProtocolUdp || offset > total) return {};
    return look_into_udp(packet.subspan(offset, total - offset), {});
}

// One's complement sum of 16-bit words, RFC 1071.
std::uint32_t sum_words(std::span<const std::byte> bytes, std::uint32_t sum) {
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        sum += std::to_integer<std::uint32_t>(bytes[i]) << (i % 2 == 0 ? 8U : 0U);
        sum = (sum & 0xffffU) + (sum >> 16U);
    }
    return sum;
}

std::uint16_t checksum_of(std::uint32_t sum) {
    return static_cast<std::uint16_t>(~((sum & 0xffffU) + (sum >> 16U)));
}

void write_ipv4(std::span<std::byte> packet, const UdpView& udp) {
    constexpr std::uint8_t kVersionAndLength = 0x45, kTimeToLive = 64;
    constexpr std::uint16_t kDontFragment = 0x4000;
    const ByteWriter writer(packet, ByteOrder::Big);
    writer.u8(0, kVersionAndLength);
    writer.u16(2, static_cast<std::uint16_t>(packet.size()));
    writer.u16(6, kDontFragment);
    writer.u8(8, kTimeToLive);
    writer.u8(9, kProtocolUdp);
    for (std::size_t i = 0; i < 4; ++i) {
        writer.u8(12 + i, udp.source_address[i]);
        writer.u8(16 + i, udp.destination_address[i]);
    }
    writer.u16(10, checksum_of(sum_words(packet.first(kIpv4Bytes), 0)));
}

// `packet` is the whole IPv4 packet: the checksum covers addresses of its header.
void write_udp(std::span<std::byte> packet, const UdpView& udp) {
    const std::span<std::byte> datagram = packet.subspan(kIpv4Bytes);
    const ByteWriter writer(datagram, ByteOrder::Big);
    writer.u16(0, udp.source_port);
    writer.u16(2, udp.destination_port);
    writer.u16(4, static_cast<std::uint16_t>(datagram.size()));
    std::copy(udp.payload.begin(), udp.payload.end(), datagram.begin() + kUdpBytes);
    const auto pseudo =
        sum_words(packet.subspan(12, 8), kProtocolUdp + static_cast<std::uint32_t>(datagram.size()));
    const std::uint16_t checksum = checksum_of(sum_words(datagram, pseudo));
    writer.u16(6, checksum == 0 ? 0xffff : checksum);
}

}  // namespace

FrameContent look_into_frame(std::span<const std::byte> frame, LinkLayer link_layer) {
    const auto offset = network_offset(ByteReader(frame, ByteOrder::Big), link_layer);
    if (!offset || *offset >= frame.size()) return {};
    const auto packet = frame.subspan(*offset);
    const unsigned version = std::to_integer<unsigned>(packet[0]) >> 4U;
    if (version == 4) return look_into_ipv4(packet);
    if (version == 6) return look_into_ipv6(packet);
    return {};
}

std::optional<std::vector<std::byte>> make_udp_frame(const UdpView& udp) {
    if (udp.payload.size() > kMaxUdpPayloadBytes) return std::nullopt;
    std::vector<std::byte> frame(kEthernetBytes + kIpv4Bytes + kUdpBytes + udp.payload.size());
    ByteWriter(frame, ByteOrder::Big).u16(12, kEtherIpv4);
    const auto packet = std::span(frame).subspan(kEthernetBytes);
    write_ipv4(packet, udp);
    write_udp(packet, udp);
    return frame;
}

}  // namespace eyepoint::net
