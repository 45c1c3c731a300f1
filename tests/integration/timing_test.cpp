/// Pacing, transport delay and idling of the whole program, with hosts that behave and hosts that do not.
#include <cmath>
#include <csignal>
#include <functional>
#include <sstream>
#include <utility>

#include <fmt/format.h>
#include <unistd.h>

#include "net/wire/fgnetfdm.hpp"
#include "tests/integration/run.hpp"
#include "tests/net/wire_bytes.hpp"

namespace eyepoint::testing {
namespace {

using net::testing::operator+;
using nlohmann::json;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std::chrono::seconds;
using Clock = std::chrono::steady_clock;

/// Due east along a parallel at 60 m/s.
std::vector<std::byte> flying(double time_s) {
    net::wire::FgNetFdm fdm;
    fdm.latitude_deg = 46.0;
    fdm.longitude_deg = 8.0 + time_s * 60.0 / 77'400.0;
    fdm.altitude_m = 2000.0;
    fdm.velocity_ned_mps = {0.0, 60.0, 0.0};
    const auto bytes = net::wire::encode_fgnetfdm24(fdm);
    return {bytes.begin(), bytes.end()};
}

std::vector<std::byte> cigi_eye(std::uint32_t host_frame, double longitude_deg) {
    return net::testing::ig_control({.host_frame = host_frame}) +
           net::testing::entity_control({.longitude = longitude_deg});
}

double nearest_rank(std::vector<double> values, double share) {
    std::ranges::sort(values);
    return values.at(static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size()))) - 1);
}

class Timing : public Run {
  protected:
    /// Sends a flight at a rate, by absolute deadlines; `between` is called before each packet.
    void fly(
        double rate_hz, double for_s, const std::function<void(double)>& between = [](double) {}) {
        const auto begin = Clock::now();
        for (int i = 0; i < static_cast<int>(for_s * rate_hz); ++i) {
            const double time_s = i / rate_hz;
            std::this_thread::sleep_until(begin + nanoseconds(std::llround(time_s * 1e9)));
            between(time_s);
            send(flying(time_s));
        }
    }

    /// The record's frames, without its header.
    [[nodiscard]] std::vector<json> frames() const {
        auto lines = read_lines(record());
        if (!lines.empty()) lines.erase(lines.begin());
        return lines;
    }

    void expect_said(const std::string& text) const {
        EXPECT_NE(log_.find(text), std::string::npos) << text << " is not in: " << log_;
    }
};

std::vector<double> delays_of(const std::vector<json>& frames) {
    std::vector<double> delays;
    for (const json& frame : frames) {
        if (frame["new_packet"]) delays.push_back(frame["arrival_to_complete_ms"]);
    }
    return delays;
}

TEST_F(Timing, TransportDelayAtSixtyHertzIsInTheRecordAndTheSummary) {
    start({"--rate", "60"});
    fly(60.0, 6.0);
    const std::string summary = end_with(SIGINT);
    const auto delays = delays_of(frames());
    ASSERT_GT(delays.size(), 200U);
    fmt::print("delay ms p50 {:.2f} p95 {:.2f} p99 {:.2f} max {:.2f} ({} packets); goal: p99 34.3\n{}",
               nearest_rank(delays, 0.5), nearest_rank(delays, 0.95), nearest_rank(delays, 0.99),
               nearest_rank(delays, 1.0), delays.size(), summary);
    EXPECT_GT(nearest_rank(delays, 0.0001), 0.0);
    // Of the median, so that a busy machine does not fail it: one period until it is drawn, one to draw it.
    EXPECT_LT(nearest_rank(delays, 0.5), 2000.0 / 60.0);
    for (const char* part : {"delay ms p50 ", " p95 ", " p99 ", " max "})
        EXPECT_NE(summary.find(part), std::string::npos) << summary;
}

TEST_F(Timing, EachFrameIsMovedOnToTheTimeItIsSeenAt) {
    start({"--rate", "100"});
    fly(20.0, 3.0);
    (void)end_with(SIGINT);
    // Twenty packets a second are 50 ms apart: half of a packet's frames lie more than 20 ms after it.
    const auto drawn = frames();
    const auto moved = std::ranges::count_if(
        drawn, [](const json& frame) { return frame["extrapolated_ms"].get<double>() > 20.0; });
    EXPECT_GT(moved, static_cast<std::ptrdiff_t>(drawn.size() / 3));
    for (const json& frame : drawn) EXPECT_LE(frame["extrapolated_ms"].get<double>(), 200.0);
}

TEST_F(Timing, WithoutExtrapolationFramesShowThePacketsPlace) {
    start({"--set", "host.extrapolation=off"});
    fly(20.0, 1.0);
    (void)end_with(SIGINT);
    for (const json& frame : frames()) {
        EXPECT_EQ(frame["extrapolated_ms"], 0.0);
        const double packet = frame["host_frame"].get<double>() - 1.0;
        EXPECT_NEAR(frame["longitude_deg"].get<double>(), 8.0 + packet / 20.0 * 60.0 / 77'400.0, 1e-9);
    }
}

TEST_F(Timing, FreePacingDrawsMoreFramesThanTheGridHas) {
    start({"--rate", "10", "--set", "frame.pacing=free"});
    fly(60.0, 2.0);
    (void)end_with(SIGINT);
    EXPECT_GT(frames().size(), 40U);
}

TEST_F(Timing, HostPacingDrawsEachPacketOnce) {
    start({"--rate", "60", "--set", "frame.pacing=host", "--end-after-silence", "1"});
    fly(25.0, 4.0);
    (void)end_with(std::nullopt);  // a silent host does not keep the run from its end
    const auto drawn = frames();
    const auto fresh = delays_of(drawn);
    EXPECT_GE(fresh.size(), 95U);
    // In the second of silence a frame every quarter of it.
    EXPECT_LE(drawn.size(), fresh.size() + 8);
    EXPECT_LT(nearest_rank(fresh, 0.5), 1000.0 / 60.0) << "drawn at arrival, not at the next deadline";
}

TEST_F(Timing, ASynchronousCigiHostAndTheFramesGoInStep) {
    start({"--rate", "60", "--set", "frame.pacing=host", "--set",
           fmt::format("host.answer_to=127.0.0.1:{}", host_.local_port())});
    std::vector<std::byte> buffer(2048);
    std::uint32_t host_frame = 0;
    for (const auto end = Clock::now() + seconds(3); Clock::now() < end;) {
        ASSERT_TRUE(host_.wait_readable(seconds(10)));
        if (!host_.receive(buffer).value()) continue;
        ++host_frame;
        send(cigi_eye(host_frame, 8.0 + host_frame * 1e-5));
    }
    (void)end_with(SIGINT);
    const auto drawn = frames();
    EXPECT_GT(drawn.size(), 60U);
    EXPECT_LT(drawn.size(), 190U) << "more frames than the rate allows";
    const auto steps = [&] {
        std::ptrdiff_t ones = 0;
        for (std::size_t i = 1; i < drawn.size(); ++i)
            ones += drawn[i]["host_frame"].get<int>() - drawn[i - 1]["host_frame"].get<int>() == 1 ? 1 : 0;
        return ones;
    }();
    EXPECT_GE(steps, static_cast<std::ptrdiff_t>(drawn.size()) * 9 / 10);
}

TEST_F(Timing, AHostAtOneHertzIsNamedAndDrawn) {
    start({"--rate", "60"});
    fly(1.0, 8.0);
    (void)end_with(SIGINT);
    expect_said("packets a second: too few");
    EXPECT_GT(frames().size(), 100U);
}

TEST_F(Timing, AHostAtAThousandHertzIsNamedAndItsNewestPacketDrawn) {
    start({"--rate", "60"});
    fly(1000.0, 6.0);
    (void)end_with(SIGINT);
    expect_said("for 60 frames: each draws the newest");
    const auto delays = delays_of(frames());
    ASSERT_GT(delays.size(), 100U);
    EXPECT_LT(nearest_rank(delays, 0.5), 1000.0 / 60.0);
}

TEST_F(Timing, ASilentHostIsNamedAndSoIsItsReturn) {
    start({"--rate", "60"});
    fly(60.0, 1.0);
    std::this_thread::sleep_for(milliseconds(3500));
    fly(60.0, 0.5);
    (void)end_with(SIGINT);
    expect_said("no packet from the host for");
    expect_said("the host speaks again after");
}

TEST_F(Timing, AStopOfFiveSecondsIsResumedWithTheNewestEyeAndNoBurst) {
    constexpr double kStopS = 2.0, kContinueS = 7.0;
    start({"--rate", "60"});
    bool stopped = false, continued = false;
    fly(200.0, 9.0, [&](double time_s) {
        if (!std::exchange(stopped, stopped || time_s >= kStopS) && stopped) program_->send_signal(SIGSTOP);
        if (!std::exchange(continued, continued || time_s >= kContinueS) && continued)
            program_->send_signal(SIGCONT);
    });
    (void)end_with(SIGINT);
    expect_said("no frame could begin for 5.");
    const auto drawn = frames();
    const auto resumed = std::ranges::find_if(
        drawn, [](const json& frame) { return frame["missed_deadlines"].get<int>() > 200; });
    ASSERT_NE(resumed, drawn.end());
    EXPECT_NEAR((*resumed)["missed_deadlines"].get<int>(), 300, 20);
    EXPECT_LE(std::distance(resumed, drawn.end()), 2 * 60 + 10) << "a burst";
    for (auto frame = resumed; frame != drawn.end(); ++frame)
        EXPECT_LT((*frame)["arrival_to_complete_ms"].get<double>(), 400.0) << "an eye from before the stop";
}

/// CPU that a process has used, of the kernel's account (man 5 proc), seconds.
double cpu_s(int process) {
    std::ifstream file(fmt::format("/proc/{}/stat", process));
    std::string text((std::istreambuf_iterator<char>(file)), {});
    std::istringstream fields(text.substr(text.rfind(')') + 2));
    std::string skipped;
    for (int i = 3; i < 14; ++i) fields >> skipped;
    double user = 0.0, system = 0.0;
    fields >> user >> system;
    return (user + system) / static_cast<double>(sysconf(_SC_CLK_TCK));
}

TEST_F(Timing, AStillEyeIsDrawnOnlyOnChangeAndCostsNextToNothing) {
    constexpr double kSeconds = 5.0;
    ASSERT_NO_FATAL_FAILURE(start({"--rate", "60", "--set", "view.width_px=640", "--set",
                                   "view.height_px=360", "--set", "frame.draw=on_change"}));
    std::vector<std::byte> buffer(2048);
    int answers = 0;
    std::uint32_t host_frame = 0;
    const auto stand_still = [&](double for_s) {
        const auto begin = Clock::now();
        for (int i = 0; i < static_cast<int>(for_s * 30.0); ++i) {
            std::this_thread::sleep_until(begin + milliseconds(i * 1000 / 30));
            send(cigi_eye(++host_frame, 8.0));
            while (host_.receive(buffer).value()) ++answers;
        }
    };
    stand_still(2.0);
    const double before_s = cpu_s(program_->id());
    answers = 0;
    stand_still(kSeconds);
    const double share = (cpu_s(program_->id()) - before_s) / kSeconds;
    const int answers_still = answers;
    send(cigi_eye(++host_frame, 8.001));
    std::this_thread::sleep_for(milliseconds(500));
    (void)end_with(SIGINT);
    fmt::print("idle: {:.2f}% CPU, {} frames drawn, {} Start Of Frames in {:g} s\n", share * 100.0,
               frames().size(), answers_still, kSeconds);
    EXPECT_LT(share, 0.02);
    EXPECT_GT(answers_still, 200) << "Start Of Frame goes on";
    EXPECT_LT(frames().size(), 20U);
    EXPECT_NEAR(frames().back()["longitude_deg"].get<double>(), 8.001, 1e-9) << "the change was not drawn";
}

}  // namespace
}  // namespace eyepoint::testing
