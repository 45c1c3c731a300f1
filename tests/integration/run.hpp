/// A run of `eyepoint` and its host, for tests of whole runs.
#pragma once

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "net/endpoint.hpp"
#include "net/pcap_file.hpp"
#include "net/udp_socket.hpp"
#include "tests/support/analytic_terrain.hpp"
#include "tools/process/child_process.hpp"

namespace eyepoint::testing {

inline constexpr std::chrono::seconds kPatience{60};

inline std::vector<nlohmann::json> read_lines(const std::filesystem::path& file) {
    std::vector<nlohmann::json> lines;
    std::ifstream stream(file);
    for (std::string text; std::getline(stream, text);) lines.push_back(nlohmann::json::parse(text));
    return lines;
}

/// One run of the program on a bare Earth, 64x48 pixels, and the host's socket.
class Run : public ::testing::Test {
  protected:
    Run() : terrain_(scratch_.path() / "terrain") {
        constexpr AnalyticTerrain kBareEarth{
            .half_size_deg = 0.01, .detail_depth = 1, .planet_depth = 0, .amplitude_m = 0.0};
        (void)make_database(kBareEarth, terrain_);
        flight_ =
            net::read_pcap(EYEPOINT_SOURCE_DIR "/tools/flights/goms-c172-60s-30hz.pcap").value().datagrams;
    }

    /// Starts the program, 100 frames a second unless the arguments say otherwise, and waits until it
    /// listens.
    void start(std::vector<std::string> arguments) {
        const auto port = net::UdpSocket::bind("127.0.0.1", 0).value().local_port();
        const std::vector<std::string> needed{
            EYEPOINT_PROGRAM, "--terrain",      terrain_.string(), "--headless",
            "--size",         "64x48",          "--rate",          "100",
            "--listen",       "127.0.0.1",      "--port",          std::to_string(port),
            "--record",       record().string()};
        arguments.insert(arguments.begin(), needed.begin(), needed.end());
        program_ = tools::ChildProcess::start(arguments).value();
        ASSERT_TRUE(program_->wait_for_error_text(
            "ready: listening on 127.0.0.1 port " + std::to_string(port), kPatience))
            << program_->wait(std::chrono::seconds(0)).standard_error;
        to_ = net::resolve_endpoint("127.0.0.1:" + std::to_string(port)).value();
    }

    void send(std::span<const std::byte> bytes) const { ASSERT_TRUE(host_.send_to(bytes, to_).has_value()); }

    /// Sends packets of the sample flight, a hundred a second.
    void send_flight(std::size_t packets) const {
        for (std::size_t i = 0; i < packets; ++i) {
            send(flight_[i].payload);
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        }
    }

    [[nodiscard]] std::string end_with(const std::optional<int>& signal) {
        if (signal) program_->send_signal(*signal);
        const tools::Ending ending = program_->wait(kPatience);
        EXPECT_EQ(ending.exit_code, 0) << ending.standard_error;
        EXPECT_EQ(std::ranges::count(ending.standard_output, '\n'), 1) << ending.standard_output;
        log_ = ending.standard_error;
        return ending.standard_output;
    }

    [[nodiscard]] std::filesystem::path record() const { return scratch_.path() / "record.jsonl"; }

    ScratchFolder scratch_;
    std::filesystem::path terrain_;
    std::vector<net::CapturedDatagram> flight_;
    net::UdpSocket host_ = net::UdpSocket::bind("127.0.0.1", 0).value();
    net::Endpoint to_;
    std::optional<tools::ChildProcess> program_;
    std::string log_;
};

}  // namespace eyepoint::testing
