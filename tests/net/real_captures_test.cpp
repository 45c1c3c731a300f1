// Captures of JSBSim, and of a host on Boeing's CIGI Class Library, beside the real data.
#include <cmath>

#include <gtest/gtest.h>

#include "net/host_session.hpp"
#include "net/wire/cigi_packets.hpp"
#include "tests/net/flights.hpp"
#include "tests/net/wire_bytes.hpp"

namespace eyepoint::net {
namespace {

constexpr std::uint16_t kToIg = 8004, kToHost = 8005, kFdmPort = 5560;

class RealCaptures : public ::testing::Test {
  protected:
    void SetUp() override {
        const auto folder = testing::captures_folder();
        if (!folder) GTEST_SKIP() << "EYEPOINT_REAL_DATA is not set: no captures to read";
        folder_ = *folder;
    }
    std::filesystem::path folder_;
};

TEST_F(RealCaptures, CigiOwnshipFliesEast) {
    for (const char* name : {"cigi32_le_async", "cigi33_le_async", "cigi33_be_async", "cigi33_le_sync"}) {
        SCOPED_TRACE(name);
        HostSession session;
        double longitude = 11.35;
        int placed = 0;
        for (const auto& datagram :
             testing::datagrams_to(folder_ / "cigi" / (std::string(name) + ".pcap"), kToIg)) {
            const auto reception = session.receive(datagram.payload, {datagram.time_ns});
            ASSERT_TRUE(reception.applied && !reception.dropped) << reception.detail;
            const EntityState* ownship = session.state()->ownship();
            if (ownship == nullptr) continue;
            ++placed;
            EXPECT_EQ(ownship->latitude_deg, 47.26);
            EXPECT_EQ(ownship->altitude_m, 2500.0);
            EXPECT_EQ(ownship->attitude.yaw_deg, 90.0);
            EXPECT_GE(ownship->longitude_deg, longitude);
            longitude = ownship->longitude_deg;
        }
        EXPECT_GT(placed, 200);
        EXPECT_NEAR(longitude, 11.3552, 1e-4);
        EXPECT_EQ(session.state()->requested_database, 3);
        EXPECT_EQ(session.state()->commanded_mode, IgMode::Operate);
        const ViewState& view = session.state()->views.at(0);
        EXPECT_EQ(view.left_deg, -30.0);
        EXPECT_EQ(view.right_deg, 30.0);
        EXPECT_EQ(view.top_deg, 20.0);
        EXPECT_EQ(view.bottom_deg, -20.0);
        EXPECT_FALSE(view.near_m.has_value());
    }
}

TEST_F(RealCaptures, OurStartOfFrameIsTheClassLibrarysBitForBit) {
    for (const char* name : {"cigi33_le_async", "cigi33_be_async", "cigi33_le_sync"}) {
        SCOPED_TRACE(name);
        for (const auto& datagram :
             testing::datagrams_to(folder_ / "cigi" / (std::string(name) + ".pcap"), kToHost)) {
            const auto theirs = std::span(datagram.payload).first(24);
            const auto start = wire::decode_start_of_frame(theirs);
            ASSERT_TRUE(start.has_value());
            const bool big = datagram.payload[6] == std::byte{0x80};
            const auto ours = wire::encode_start_of_frame(
                *start, {big ? wire::ByteOrder::Big : wire::ByteOrder::Little, false});
            ASSERT_TRUE(std::equal(ours.begin(), ours.end(), theirs.begin(), theirs.end()))
                << start->ig_frame;
        }
    }
}

TEST_F(RealCaptures, Cigi4IsRefusedByName) {
    for (const char* name : {"cigi40_le_async.pcap", "cigi40_be_async.pcap"}) {
        HostSession session;
        const auto datagrams = testing::datagrams_to(folder_ / "cigi" / name, kToIg);
        for (const auto& datagram : datagrams) {
            const auto reception = session.receive(datagram.payload, {});
            EXPECT_EQ(reception.dropped, DropReason::WrongVersion);
            EXPECT_NE(reception.detail.find("4.0"), std::string::npos);
        }
        EXPECT_GT(datagrams.size(), 100U);
        EXPECT_EQ(session.state(), nullptr);
    }
}

TEST_F(RealCaptures, EveryTruncationOfRealCigiMessagesIsSurvived) {
    const auto datagrams = testing::datagrams_to(folder_ / "cigi/cigi33_be_async.pcap", kToIg);
    for (std::size_t i = 0; i < 20; ++i) {
        const auto& whole = datagrams[i].payload;
        for (std::size_t size = 0; size < whole.size(); ++size) {
            HostSession session;
            const auto reception = session.receive(testing::ExactCopy(whole, size).span(), {});
            EXPECT_EQ(reception.applied, size >= 24);
        }
    }
}

TEST_F(RealCaptures, JsbsimFliesWhereTheReadmeSays) {
    HostSession session;
    const auto datagrams = testing::datagrams_to(folder_ / "goms-c172.pcap", kFdmPort);
    ASSERT_EQ(datagrams.size(), 11401U);
    for (const auto& datagram : datagrams) {
        ASSERT_TRUE(session.receive(datagram.payload, {datagram.time_ns}).applied);
        const EntityState& ownship = *session.state()->ownship();
        EXPECT_NEAR(ownship.latitude_deg, 46.45, 0.1);
        EXPECT_NEAR(ownship.longitude_deg, 8.2, 0.12);
        EXPECT_NEAR(ownship.altitude_m, 3050.0, 60.0);
        EXPECT_LT(std::abs(ownship.attitude.roll_deg), 35.0);
    }
}

TEST_F(RealCaptures, TheFastJetIsTakenWholly) {
    HostSession session;
    for (const auto& datagram : testing::datagrams_to(folder_ / "alps-737.pcap", kFdmPort)) {
        session.receive(datagram.payload, {datagram.time_ns});
    }
    EXPECT_EQ(session.counters().applied, 9002U);
    EXPECT_EQ(session.counters().dropped_total(), 0U);
}

}  // namespace
}  // namespace eyepoint::net
