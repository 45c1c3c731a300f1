#include "net/udp_socket.hpp"

#include <array>
#include <chrono>

#include <gtest/gtest.h>

#include "tests/net/wire_bytes.hpp"

namespace eyepoint::net {
namespace {

using namespace std::chrono_literals;
using testing::Bytes;
using testing::operator+;

UdpSocket on_loopback(const std::string& address = "127.0.0.1") {
    auto socket = UdpSocket::bind(address, 0);
    if (!socket) throw std::runtime_error(socket.error());
    return std::move(*socket);
}

Endpoint to(const UdpSocket& socket) {
    return *resolve_endpoint("127.0.0.1:" + std::to_string(socket.local_port()));
}

TEST(UdpSocket, DeliversADatagramWithItsSenderAndArrivalTime) {
    const UdpSocket receiver = on_loopback(), sender = on_loopback();
    const auto now_ns = [] {
        return std::chrono::duration_cast<std::chrono::nanoseconds>(
                   std::chrono::system_clock::now().time_since_epoch())
            .count();
    };
    const auto before = now_ns();
    const Bytes sent = testing::from_hex("0011223344");
    ASSERT_TRUE(sender.send_to(sent, to(receiver)).has_value());
    ASSERT_TRUE(receiver.wait_readable(2000ms));
    std::array<std::byte, 2000> buffer{};
    const auto received = receiver.receive(buffer);
    ASSERT_TRUE(received.has_value() && received->has_value());
    EXPECT_EQ((*received)->size, sent.size());
    EXPECT_FALSE((*received)->truncated);
    EXPECT_TRUE(std::equal(sent.begin(), sent.end(), buffer.begin()));
    EXPECT_EQ((*received)->sender.port(), sender.local_port());
    EXPECT_EQ((*received)->sender.text(), "127.0.0.1:" + std::to_string(sender.local_port()));
    EXPECT_GE((*received)->arrival.realtime_ns, before);
    EXPECT_LE((*received)->arrival.realtime_ns, now_ns());
}

TEST(UdpSocket, ReceivingNeverBlocks) {
    const UdpSocket receiver = on_loopback();
    std::array<std::byte, 16> buffer{};
    const auto received = receiver.receive(buffer);
    ASSERT_TRUE(received.has_value());
    EXPECT_FALSE(received->has_value());
    EXPECT_FALSE(receiver.wait_readable(0ms));
}

TEST(UdpSocket, SaysWhenADatagramWasLongerThanTheBuffer) {
    const UdpSocket receiver = on_loopback(), sender = on_loopback();
    ASSERT_TRUE(sender.send_to(Bytes(100), to(receiver)).has_value());
    ASSERT_TRUE(receiver.wait_readable(2000ms));
    std::array<std::byte, 64> buffer{};
    const auto received = receiver.receive(buffer);
    ASSERT_TRUE(received.has_value() && received->has_value());
    EXPECT_TRUE((*received)->truncated);
    EXPECT_EQ((*received)->size, 64U);
}

TEST(UdpSocket, ABusyPortIsNamedWithTheRemedy) {
    const UdpSocket first = on_loopback();
    const auto second = UdpSocket::bind("127.0.0.1", first.local_port());
    ASSERT_FALSE(second.has_value());
    EXPECT_NE(second.error().find(std::to_string(first.local_port())), std::string::npos);
    EXPECT_NE(second.error().find("in use"), std::string::npos);
    EXPECT_NE(second.error().find("another port"), std::string::npos);
}

TEST(UdpSocket, AnAddressThatIsNotOursIsNamed) {
    const auto other = UdpSocket::bind("192.0.2.1", 0);
    ASSERT_FALSE(other.has_value());
    EXPECT_NE(other.error().find("192.0.2.1"), std::string::npos);
    const auto name = UdpSocket::bind("no address", 0);
    ASSERT_FALSE(name.has_value());
    EXPECT_NE(name.error().find("'no address'"), std::string::npos);
}

TEST(UdpSocket, MovesItsDescriptor) {
    UdpSocket first = on_loopback();
    const std::uint16_t port = first.local_port();
    const UdpSocket second = std::move(first);
    EXPECT_EQ(second.local_port(), port);
    EXPECT_FALSE(UdpSocket::bind("127.0.0.1", port).has_value());
}

TEST(Endpoint, IsReadFromHostAndPort) {
    EXPECT_EQ(resolve_endpoint("127.0.0.1:5560")->text(), "127.0.0.1:5560");
    EXPECT_EQ(resolve_endpoint("[::1]:5560")->text(), "[::1]:5560");
    EXPECT_EQ(resolve_endpoint("localhost:80", AF_INET)->text(), "127.0.0.1:80");
    for (const char* bad : {"", "127.0.0.1", ":5560", "127.0.0.1:", "127.0.0.1:0", "127.0.0.1:65536",
                            "127.0.0.1:55x", "::1:5560", "[]:5560"}) {
        const auto endpoint = resolve_endpoint(bad);
        ASSERT_FALSE(endpoint.has_value()) << bad;
        EXPECT_NE(endpoint.error().find("HOST:PORT"), std::string::npos);
    }
    EXPECT_FALSE(resolve_endpoint("no.such.host.invalid:5560").has_value());
}

}  // namespace
}  // namespace eyepoint::net
