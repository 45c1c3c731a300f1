/// A run of `eyepoint` as a host sees it: packets in, pictures, records and answers out, and a clean end.
#include "tests/integration/run.hpp"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace eyepoint::testing {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using std::chrono::milliseconds;
using std::chrono::seconds;

TEST_F(Run, EndsAfterTheFramesAskedForWithAPictureAndARecordLineEach) {
    const fs::path pictures = scratch_.path() / "pictures";
    start({"--output", pictures.string(), "--frames", "5"});
    send_flight(20);
    EXPECT_EQ(end_with(std::nullopt).find("5 frames in "), 0U);
    for (int frame = 1; frame <= 5; ++frame) {
        EXPECT_TRUE(fs::exists(pictures / ("frame-00000" + std::to_string(frame) + ".png"))) << frame;
    }
    EXPECT_EQ(std::distance(fs::directory_iterator(pictures), fs::directory_iterator()), 5);

    const std::vector<json> lines = read_lines(record());
    ASSERT_EQ(lines.size(), 6U);
    EXPECT_EQ(lines[0]["width_px"], 64);
    for (std::size_t frame = 1; frame <= 5; ++frame) {
        EXPECT_EQ(lines[frame]["frame"], frame);
        EXPECT_GT(lines[frame]["arrival_to_complete_ms"], 0.0);
        // The flight begins at 46.40 N 8.13 E (its README); the record tells where the eye is.
        EXPECT_NEAR(lines[frame]["latitude_deg"].get<double>(), 46.40, 0.02);
        EXPECT_NEAR(lines[frame]["longitude_deg"].get<double>(), 8.13, 0.02);
    }
}

TEST_F(Run, EndsAfterTheHostsSilence) {
    start({"--end-after-silence", "0.5"});
    send_flight(30);
    const auto last_packet = std::chrono::steady_clock::now();
    const std::string summary = end_with(std::nullopt);
    EXPECT_GE(std::chrono::steady_clock::now() - last_packet, milliseconds(450));
    EXPECT_NE(summary.find("30 packets"), std::string::npos) << summary;
}

TEST_F(Run, DrawsNothingBeforeTheFirstPacketAndEndsByCtrlC) {
    start({});
    std::this_thread::sleep_for(milliseconds(200));
    EXPECT_EQ(end_with(SIGINT).find("0 frames in 0.0 s"), 0U);
    EXPECT_EQ(read_lines(record()).size(), 1U);
}

TEST_F(Run, SigtermEndsARunInFlightWithItsSummary) {
    start({});
    send_flight(20);
    const std::string summary = end_with(SIGTERM);
    EXPECT_NE(summary.find("missed deadlines"), std::string::npos) << summary;
    EXPECT_NE(summary.find("peak memory"), std::string::npos) << summary;
    EXPECT_GT(read_lines(record()).size(), 1U);
}

TEST_F(Run, BadPacketsAreCountedAndToldOnceASecondAndTheEyeStays) {
    start({});
    send_flight(5);
    std::this_thread::sleep_for(milliseconds(100));
    const std::vector<std::byte> cut(flight_[0].payload.begin(), flight_[0].payload.begin() + 50);
    for (int i = 0; i < 40; ++i) {
        send(cut);
        std::this_thread::sleep_for(milliseconds(10));
    }
    std::this_thread::sleep_for(milliseconds(200));
    const std::string summary = end_with(SIGINT);
    EXPECT_NE(summary.find("45 packets, 40 dropped: 40 short"), std::string::npos) << summary;
    std::size_t told = 0;
    for (auto at = log_.find("bad packets"); at != std::string::npos; at = log_.find("bad packets", at + 1))
        ++told;
    EXPECT_GE(told, 1U) << log_;
    EXPECT_LE(told, 2U) << log_;
    const std::vector<json> lines = read_lines(record());
    ASSERT_GT(lines.size(), 10U);
    EXPECT_EQ(lines.back()["host_frame"], 5);
    EXPECT_NEAR(lines.back()["latitude_deg"].get<double>(), 46.40, 0.02);
}

TEST_F(Run, StartOfFrameGoesToTheConfiguredHostFromTheBeginning) {
    start({"--set", "host.answer_to=127.0.0.1:" + std::to_string(host_.local_port())});
    std::vector<std::byte> buffer(2048);
    for (int answer = 0; answer < 3; ++answer) {
        ASSERT_TRUE(host_.wait_readable(seconds(10)));
        const auto datagram = host_.receive(buffer).value();
        ASSERT_TRUE(datagram.has_value());
        ASSERT_EQ(datagram->size, 24U);  // CIGI 3.3, Start Of Frame: packet 101 of 24 bytes
        EXPECT_EQ(buffer[0], std::byte{101});
        EXPECT_EQ(buffer[1], std::byte{24});
    }
    (void)end_with(SIGINT);
}

}  // namespace
}  // namespace eyepoint::testing
