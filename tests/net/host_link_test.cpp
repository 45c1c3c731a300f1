#include "net/host_link.hpp"

#include <chrono>

#include <gtest/gtest.h>

#include "net/wire/fgnetfdm.hpp"
#include "tests/net/wire_bytes.hpp"

namespace eyepoint::net {
namespace {

using namespace std::chrono_literals;
using testing::Bytes;
using testing::operator+;
using testing::entity_control;
using testing::ig_control;

// A host beside a link, both on the loopback interface.
class HostLinkTest : public ::testing::Test {
  protected:
    void send(const Bytes& bytes) { ASSERT_TRUE(host_.send_to(bytes, ig_).has_value()); }
    // The datagram that the host has got, empty where none has come.
    Bytes got(const UdpSocket& socket, std::chrono::milliseconds wait) {
        Bytes buffer(2000);
        if (!socket.wait_readable(wait)) return {};
        const auto received = socket.receive(buffer);
        buffer.resize((*received)->size);
        return buffer;
    }
    static UdpSocket open_socket() { return std::move(*UdpSocket::bind("127.0.0.1", 0)); }

    HostLink link_ = std::move(*HostLink::open({"127.0.0.1", 0, ""}));
    UdpSocket host_ = open_socket();
    Endpoint ig_ = *resolve_endpoint("127.0.0.1:" + std::to_string(link_.local_port()));
};

TEST_F(HostLinkTest, TheNewestDatagramIsTheOneInForce) {
    for (std::uint32_t frame = 1; frame <= 5; ++frame) {
        send(ig_control({.host_frame = frame}) + entity_control({.altitude = 1000.0 * frame}));
    }
    const PollResult result = link_.wait_and_poll(2000ms);
    EXPECT_EQ(result.datagrams, 5U);
    EXPECT_EQ(result.applied, 5U);
    EXPECT_EQ(result.dropped, 0U);
    EXPECT_EQ(link_.state()->host_frame, 5U);
    EXPECT_EQ(link_.state()->ownship()->altitude_m, 5000.0);
    EXPECT_GT(link_.state()->arrival.realtime_ns, 0);
    EXPECT_EQ(link_.poll().datagrams, 0U);
}

TEST_F(HostLinkTest, AFloodIsTakenInPortions) {
    for (int i = 0; i < 300; ++i) send(Bytes(20, std::byte{0x55}));
    const PollResult first = link_.wait_and_poll(2000ms);
    EXPECT_EQ(first.datagrams, HostLink::kDatagramsPerPoll);
    EXPECT_EQ(first.details.size(), HostLink::kDetailsPerPoll);
    EXPECT_EQ(link_.poll().datagrams, 300U - HostLink::kDatagramsPerPoll);
    EXPECT_EQ(link_.counters().dropped_total(), 300U);
}

TEST_F(HostLinkTest, AnswersWhoeverSpokeValidCigi) {
    EXPECT_EQ(link_.answer({}), false);
    send(ig_control({.host_frame = 12}));
    link_.wait_and_poll(2000ms);
    EXPECT_EQ(link_.answer({.ig_frame = 3}), true);
    const auto start = wire::decode_start_of_frame(got(host_, 2000ms));
    ASSERT_TRUE(start.has_value());
    EXPECT_EQ(start->ig_frame, 3U);
    EXPECT_EQ(start->last_host_frame, 12U);
}

TEST_F(HostLinkTest, SendsNothingToOneWhoHasNotSpokenValidCigi) {
    const UdpSocket stranger = open_socket();
    ASSERT_TRUE(stranger.send_to(Bytes(64, std::byte{1}), ig_).has_value());
    link_.wait_and_poll(2000ms);
    EXPECT_EQ(link_.answer({}), false);
    send(ig_control({}));
    link_.wait_and_poll(2000ms);
    ASSERT_TRUE(stranger.send_to(Bytes(64, std::byte{1}), ig_).has_value());
    link_.wait_and_poll(2000ms);
    EXPECT_EQ(link_.answer({}), true);
    EXPECT_FALSE(got(host_, 2000ms).empty());
    EXPECT_TRUE(got(stranger, 0ms).empty());
}

TEST_F(HostLinkTest, FgNetFdmHasNoAnswer) {
    const auto fdm = wire::encode_fgnetfdm24({});
    send(Bytes(fdm.begin(), fdm.end()));
    EXPECT_EQ(link_.wait_and_poll(2000ms).applied, 1U);
    EXPECT_EQ(link_.answer({}), false);
}

TEST_F(HostLinkTest, DropsNameTheirSender) {
    send(Bytes(64, std::byte{1}));
    const PollResult result = link_.wait_and_poll(2000ms);
    ASSERT_EQ(result.details.size(), 1U);
    EXPECT_NE(result.details[0].find("127.0.0.1:" + std::to_string(host_.local_port())), std::string::npos);
}

TEST(HostLink, AConfiguredHostIsAnsweredFromTheFirstFrameOn) {
    const auto host = UdpSocket::bind("127.0.0.1", 0);
    ASSERT_TRUE(host.has_value());
    auto link = HostLink::open({"127.0.0.1", 0, "127.0.0.1:" + std::to_string(host->local_port())});
    ASSERT_TRUE(link.has_value()) << link.error();
    EXPECT_EQ(link->answer({}), true);
    EXPECT_TRUE(host->wait_readable(2000ms));
}

TEST(HostLink, FaultsOfItsSettingsAreOneSentence) {
    EXPECT_FALSE(HostLink::open({"127.0.0.1", 0, "nowhere"}).has_value());
    EXPECT_FALSE(HostLink::open({"nowhere", 0, ""}).has_value());
}

}  // namespace
}  // namespace eyepoint::net
