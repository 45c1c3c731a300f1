// Two processes of the built program: one records what the other plays.
#include <cmath>
#include <csignal>
#include <string>
#include <vector>

#include <sys/wait.h>

#include <gtest/gtest.h>
#include <spawn.h>
#include <unistd.h>

#include "net/pcap_file.hpp"
#include "net/udp_socket.hpp"
#include "tests/net/flights.hpp"
#include "tests/net/scratch.hpp"

namespace eyepoint::tools {
namespace {

using net::testing::Scratch;

const std::string kProgram = std::string(EYEPOINT_BINARY_DIR) + "/bin/eyepoint-replay";

pid_t start(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), kProgram);
    std::vector<char*> pointers;
    for (std::string& argument : arguments) pointers.push_back(argument.data());
    pointers.push_back(nullptr);
    pid_t process = 0;
    const int failure = ::posix_spawn(&process, kProgram.c_str(), nullptr, nullptr, pointers.data(), environ);
    EXPECT_EQ(failure, 0) << kProgram;
    return process;
}

int exit_code(pid_t process) {
    int status = 0;
    ::waitpid(process, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

std::uint16_t free_port() { return net::UdpSocket::bind("127.0.0.1", 0)->local_port(); }

// Waits until someone listens on the port.
void wait_for_listener(std::uint16_t port) {
    for (int i = 0; i < 200 && net::UdpSocket::bind("0.0.0.0", port).has_value(); ++i) ::usleep(20'000);
}

TEST(ReplayProcesses, WhatIsPlayedIsRecordedAtItsTimes) {
    const Scratch scratch;
    const std::string file = (scratch / "again.pcap").string();
    const std::string port = std::to_string(free_port());
    const pid_t recorder = start({"record", "--port", port, "-o", file});
    wait_for_listener(static_cast<std::uint16_t>(std::stoi(port)));
    ASSERT_EQ(exit_code(start({"play", net::testing::sample_flight().string(), "--to", "127.0.0.1:" + port,
                               "--from", "5", "--until", "9", "--rate", "2"})),
              0);
    ::kill(recorder, SIGINT);
    ASSERT_EQ(exit_code(recorder), 0);

    std::vector<net::CapturedDatagram> sent;
    const auto all = net::testing::datagrams_to(net::testing::sample_flight(), 5560);
    for (const auto& datagram : all) {
        const double at_s = static_cast<double>(datagram.time_ns - all.front().time_ns) * 1e-9;
        if (at_s >= 5.0 && at_s <= 9.0) sent.push_back(datagram);
    }
    const auto got = net::read_pcap(file);
    ASSERT_TRUE(got.has_value()) << got.error();
    ASSERT_EQ(got->datagrams.size(), sent.size());
    std::size_t late = 0;
    for (std::size_t i = 0; i < sent.size(); ++i) {
        EXPECT_EQ(got->datagrams[i].payload, sent[i].payload);
        const double due_s = static_cast<double>(sent[i].time_ns - sent.front().time_ns) * 1e-9 / 2.0;
        const double came_s =
            static_cast<double>(got->datagrams[i].time_ns - got->datagrams.front().time_ns) * 1e-9;
        // A loaded machine may be late now and then; deadlines are absolute, so lateness must not add up.
        late += std::abs(came_s - due_s) > 0.010 ? 1 : 0;
        EXPECT_LT(std::abs(came_s - due_s), 0.250) << i;
    }
    EXPECT_LE(late, sent.size() / 5);
}

TEST(ReplayProcesses, ALoopGoesOnUntilStopped) {
    const auto receiver = net::UdpSocket::bind("127.0.0.1", 0);
    ASSERT_TRUE(receiver.has_value());
    const pid_t player =
        start({"play", net::testing::sample_flight().string(), "--to",
               "127.0.0.1:" + std::to_string(receiver->local_port()), "--until", "0.1", "--loop"});
    std::vector<std::byte> buffer(2000);
    int packets = 0;
    while (packets < 12 && receiver->wait_readable(std::chrono::milliseconds(5000))) {
        packets += receiver->receive(buffer)->has_value() ? 1 : 0;
    }
    ::kill(player, SIGTERM);
    EXPECT_EQ(exit_code(player), 0);
    EXPECT_EQ(packets, 12);  // a tenth of a second holds four
}

TEST(ReplayProcesses, RecordingEndsByItselfAndSaysWhenNothingCame) {
    const Scratch scratch;
    const std::string file = (scratch / "nothing.pcap").string();
    EXPECT_EQ(exit_code(start({"record", "--port", std::to_string(free_port()), "-o", file, "--for", "0.2"})),
              1);
    EXPECT_TRUE(std::filesystem::is_empty(scratch.folder()));
}

TEST(ReplayProcesses, FaultsEndWithCodeOne) {
    const auto busy = net::UdpSocket::bind("0.0.0.0", 0);
    const Scratch scratch;
    const std::string file = (scratch / "x.pcap").string();
    EXPECT_EQ(exit_code(start({"record", "--port", std::to_string(busy->local_port()), "-o", file})), 1);
    EXPECT_EQ(exit_code(start({"play", "missing.pcap", "--to", "127.0.0.1:5560"})), 1);
    EXPECT_EQ(exit_code(start({"info", "missing.pcap"})), 1);
    EXPECT_EQ(exit_code(start({"fly"})), 1);
    EXPECT_EQ(exit_code(start({"--help"})), 0);
}

}  // namespace
}  // namespace eyepoint::tools
