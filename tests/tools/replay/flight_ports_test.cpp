#include "tools/replay/flight_ports.hpp"

#include <gtest/gtest.h>

#include "tests/net/flights.hpp"
#include "tools/replay/info.hpp"

namespace eyepoint::tools {
namespace {

net::PcapRecording noise_and_flight() {
    auto recording = *net::read_pcap(net::testing::sample_flight());
    recording.datagrams.resize(100);
    for (int i = 0; i < 200; ++i) {
        net::CapturedDatagram noise = recording.datagrams.front();
        noise.destination_port = 53;
        noise.payload.assign(40, std::byte{0x41});
        recording.datagrams.push_back(noise);
    }
    return recording;
}

TEST(FlightPorts, ThePortWithTheMostValidDatagramsComesFirst) {
    const auto summaries = summarize_ports(noise_and_flight());
    ASSERT_EQ(summaries.size(), 2U);
    EXPECT_EQ(summaries[0].port, 5560);
    EXPECT_EQ(summaries[0].datagrams, 100U);
    EXPECT_EQ(summaries[0].protocol, net::Protocol::FgNetFdm);
    EXPECT_NEAR(summaries[0].median_spacing_s, 1.0 / 30.0, 0.002);
    EXPECT_NEAR(summaries[0].altitude_m->lowest, 3043.0, 10.0);
    EXPECT_EQ(summaries[1].port, 53);
    EXPECT_EQ(summaries[1].counters.dropped_total(), 200U);
    EXPECT_FALSE(summaries[1].protocol.has_value());
    EXPECT_FALSE(summaries[1].first_drop.empty());
}

TEST(FlightPorts, ThePortIsChosenOrGiven) {
    const auto recording = noise_and_flight();
    EXPECT_EQ(choose_port(recording, std::nullopt), 5560);
    EXPECT_EQ(choose_port(recording, 53), 53);
    const auto none = choose_port(recording, 80);
    ASSERT_FALSE(none.has_value());
    EXPECT_NE(none.error().find("5560 (100)"), std::string::npos);
    EXPECT_FALSE(choose_port({}, std::nullopt).has_value());
}

TEST(DescribeFlight, SaysWhatTheSampleFlightHolds) {
    const auto text = describe_flight(net::testing::sample_flight());
    ASSERT_TRUE(text.has_value()) << text.error();
    for (const char* words :
         {"1800 UDP datagrams", "port 5560", "FGNetFDM", "rate 30.0", "latitude 46.40241 to 46.41592"}) {
        EXPECT_NE(text->find(words), std::string::npos) << words << " in\n" << *text;
    }
    EXPECT_EQ(text->find("dropped"), std::string::npos);
}

}  // namespace
}  // namespace eyepoint::tools
