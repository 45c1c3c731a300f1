#include "net/udp_datagram.hpp"

#include <gtest/gtest.h>

#include "tests/net/wire_bytes.hpp"

namespace eyepoint::net {
namespace {

using testing::Bytes;
using testing::operator+;
using testing::ExactCopy;
using testing::from_hex;
using Kind = FrameContent::Kind;

const Bytes kPayload = from_hex("0102030405");
const UdpView kUdp{{10, 0, 0, 1}, {10, 0, 0, 2}, 4000, 5560, kPayload};

Bytes ip_packet() {
    const Bytes frame = *make_udp_frame(kUdp);
    return {frame.begin() + 14, frame.end()};
}

void expect_udp(const Bytes& frame, LinkLayer link_layer) {
    const ExactCopy exact(frame);
    const FrameContent content = look_into_frame(exact.span(), link_layer);
    ASSERT_EQ(content.kind, Kind::Udp);
    EXPECT_EQ(content.udp.source_port, 4000);
    EXPECT_EQ(content.udp.destination_port, 5560);
    EXPECT_TRUE(
        std::equal(content.udp.payload.begin(), content.udp.payload.end(), kPayload.begin(), kPayload.end()));
}

TEST(UdpDatagram, ComesBackFromItsFrame) {
    const Bytes frame = *make_udp_frame(kUdp);
    expect_udp(frame, LinkLayer::Ethernet);
    const auto content = look_into_frame(frame, LinkLayer::Ethernet);
    EXPECT_EQ(content.udp.source_address, kUdp.source_address);
    EXPECT_EQ(content.udp.destination_address, kUdp.destination_address);
}

TEST(UdpDatagram, IsFoundInEveryLinkLayer) {
    expect_udp(ip_packet(), LinkLayer::RawIp);
    expect_udp(from_hex("02000000") + ip_packet(), LinkLayer::BsdLoopback);
    expect_udp(from_hex("00000304000600000000000000000800") + ip_packet(), LinkLayer::LinuxCooked);
    expect_udp(from_hex("0800000000000001030400060000000000000000") + ip_packet(), LinkLayer::LinuxCooked2);
    expect_udp(Bytes(12) + from_hex("810000640800") + ip_packet(), LinkLayer::Ethernet);          // 802.1Q
    expect_udp(Bytes(12) + from_hex("88a80064810000650800") + ip_packet(), LinkLayer::Ethernet);  // 802.1ad
    expect_udp(*make_udp_frame(kUdp) + Bytes(13), LinkLayer::Ethernet);                           // padded
}

TEST(UdpDatagram, IsFoundInIpv6) {
    const Bytes udp = from_hex("0fa015b8000d0000") + kPayload;
    const Bytes addresses(32);
    expect_udp(from_hex("60000000000d1140") + addresses + udp, LinkLayer::RawIp);
    // Behind a hop-by-hop extension header of eight bytes.
    expect_udp(from_hex("6000000000150040") + addresses + from_hex("1100050200000000") + udp,
               LinkLayer::RawIp);
    const auto fragment = look_into_frame(
        from_hex("6000000000152c40") + addresses + from_hex("1100000100000000") + udp, LinkLayer::RawIp);
    EXPECT_EQ(fragment.kind, Kind::Fragment);
}

TEST(UdpDatagram, FragmentsAndOtherProtocolsAreTold) {
    Bytes fragment = ip_packet();
    fragment[6] = std::byte{0x20};
    EXPECT_EQ(look_into_frame(fragment, LinkLayer::RawIp).kind, Kind::Fragment);
    Bytes tcp = ip_packet();
    tcp[9] = std::byte{6};
    EXPECT_EQ(look_into_frame(tcp, LinkLayer::RawIp).kind, Kind::Other);
    Bytes arp = *make_udp_frame(kUdp);
    arp[13] = std::byte{6};
    EXPECT_EQ(look_into_frame(arp, LinkLayer::Ethernet).kind, Kind::Other);
}

TEST(UdpDatagram, EveryTruncationIsOther) {
    const Bytes frame = *make_udp_frame(kUdp);
    for (std::size_t size = 0; size < frame.size(); ++size) {
        const ExactCopy cut(frame, size);
        EXPECT_EQ(look_into_frame(cut.span(), LinkLayer::Ethernet).kind, Kind::Other) << size;
    }
}

TEST(UdpDatagram, LengthsThatLieAreOther) {
    Bytes long_udp = ip_packet();
    long_udp[25] = std::byte{0xff};
    EXPECT_EQ(look_into_frame(long_udp, LinkLayer::RawIp).kind, Kind::Other);
    Bytes short_header = ip_packet();
    short_header[0] = std::byte{0x41};
    EXPECT_EQ(look_into_frame(short_header, LinkLayer::RawIp).kind, Kind::Other);
}

TEST(UdpDatagram, APayloadTooLongForIpv4HasNoFrame) {
    const Bytes most(kMaxUdpPayloadBytes), more(kMaxUdpPayloadBytes + 1);
    EXPECT_TRUE(make_udp_frame({{}, {}, 1, 2, most}).has_value());
    EXPECT_FALSE(make_udp_frame({{}, {}, 1, 2, more}).has_value());
}

}  // namespace
}  // namespace eyepoint::net
