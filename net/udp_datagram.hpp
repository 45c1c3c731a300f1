/// UDP datagrams inside captured link-layer frames, out of them and into them. Pure, over bytes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace eyepoint::net {

/// The link layers that are understood.
enum class LinkLayer : std::uint8_t {
    Ethernet,     ///< with or without 802.1Q and 802.1ad tags
    LinuxCooked,  ///< version 1
    LinuxCooked2,
    RawIp,
    BsdLoopback,
};

/// Where a frame's UDP payload lies.
struct UdpView {
    std::array<std::uint8_t, 4> source_address{};       ///< 0.0.0.0 for IPv6
    std::array<std::uint8_t, 4> destination_address{};  ///< 0.0.0.0 for IPv6
    std::uint16_t source_port = 0;
    std::uint16_t destination_port = 0;
    std::span<const std::byte> payload;  ///< into the frame
};

struct FrameContent {
    enum class Kind : std::uint8_t { Udp, Fragment, Other };
    Kind kind = Kind::Other;
    UdpView udp;  ///< of Kind::Udp
};

/// Looks into a frame. Malformed ones are Kind::Other. Checksums are not looked at: captures on the sending
/// machine hold frames whose checksums the network card had yet to fill in.
[[nodiscard]] FrameContent look_into_frame(std::span<const std::byte> frame, LinkLayer link_layer);

inline constexpr std::size_t kMaxUdpPayloadBytes = 65507;

/// An Ethernet/IPv4/UDP frame with checksums (RFC 791, RFC 768); nullopt when the payload is longer than IPv4
/// can carry.
[[nodiscard]] std::optional<std::vector<std::byte>> make_udp_frame(const UdpView& udp);

}  // namespace eyepoint::net
