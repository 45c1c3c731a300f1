/// A run of `eyepoint` as a host sees it: packets in, pictures, records and answers out, and a clean end.
#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "net/endpoint.hpp"
#include "net/pcap_file.hpp"
#include "net/udp_socket.hpp"
#include "tests/integration/child_process.hpp"
#include "tests/support/analytic_terrain.hpp"

namespace eyepoint::testing {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr AnalyticTerrain kBareEarth{
    .half_size_deg = 0.01, .detail_depth = 1, .planet_depth = 0, .amplitude_m = 0.0};
constexpr seconds kPatience{60};

std::vector<json> read_lines(const fs::path& file) {
    std::vector<json> lines;
    std::ifstream stream(file);
    for (std::string text; std::getline(stream, text);) lines.push_back(json::parse(text));
    return lines;
}

/// One run of the program on a bare Earth, 64x48 pixels, and the host's socket.
class Run : public ::testing::Test {
  protected:
    Run() : terrain_(scratch_.path() / "terrain") {
        (void)make_database(kBareEarth, terrain_);
        flight_ =
            net::read_pcap(EYEPOINT_SOURCE_DIR "/tools/flights/goms-c172-60s-30hz.pcap").value().datagrams;
    }

    /// Starts the program and waits until it listens.
    void start(std::vector<std::string> arguments) {
        const auto port = net::UdpSocket::bind("127.0.0.1", 0).value().local_port();
        const std::vector<std::string> needed{
            EYEPOINT_PROGRAM, "--terrain",      terrain_.string(), "--headless",
            "--size",         "64x48",          "--rate",          "100",
            "--listen",       "127.0.0.1",      "--port",          std::to_string(port),
            "--record",       record().string()};
        arguments.insert(arguments.begin(), needed.begin(), needed.end());
        program_.emplace(arguments);
        ASSERT_TRUE(program_->wait_for_error_text(
            "ready: listening on 127.0.0.1 port " + std::to_string(port), kPatience))
            << program_->wait(seconds(0)).standard_error;
        to_ = net::resolve_endpoint("127.0.0.1:" + std::to_string(port)).value();
    }

    void send(std::span<const std::byte> bytes) const { ASSERT_TRUE(host_.send_to(bytes, to_).has_value()); }

    /// Sends packets of the sample flight, a hundred a second.
    void send_flight(std::size_t packets) const {
        for (std::size_t i = 0; i < packets; ++i) {
            send(flight_[i].payload);
            std::this_thread::sleep_for(milliseconds(10));
        }
    }

    [[nodiscard]] std::string end_with(const std::optional<int>& signal) {
        if (signal) program_->send_signal(*signal);
        const Ending ending = program_->wait(kPatience);
        EXPECT_EQ(ending.exit_code, 0) << ending.standard_error;
        EXPECT_EQ(std::ranges::count(ending.standard_output, '\n'), 1) << ending.standard_output;
        log_ = ending.standard_error;
        return ending.standard_output;
    }

    [[nodiscard]] fs::path record() const { return scratch_.path() / "record.jsonl"; }

    ScratchFolder scratch_;
    fs::path terrain_;
    std::vector<net::CapturedDatagram> flight_;
    net::UdpSocket host_ = net::UdpSocket::bind("127.0.0.1", 0).value();
    net::Endpoint to_;
    std::optional<ChildProcess> program_;
    std::string log_;
};

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
