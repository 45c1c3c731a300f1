/// A host on the loopback interface, heard with a clock whose system time can be set.
#include "ig/heard_host.hpp"

#include <chrono>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "net/endpoint.hpp"
#include "net/udp_socket.hpp"
#include "net/wire/fgnetfdm.hpp"

namespace eyepoint::ig {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using namespace std::chrono_literals;

/// The machine's clocks; the system time set by so much, as this process sees it.
class SetClock final : public Clock {
  public:
    std::int64_t now_ns() override { return system_.now_ns(); }
    std::int64_t realtime_ns() override { return system_.realtime_ns() + set_by_ns; }
    void sleep_until(std::int64_t deadline_ns) override { system_.sleep_until(deadline_ns); }

    std::int64_t set_by_ns = 0;

  private:
    SystemClock system_;
};

class Heard : public ::testing::Test {
  protected:
    void send(double latitude_deg, double north_mps) {
        net::wire::FgNetFdm fdm;
        fdm.latitude_deg = latitude_deg;
        fdm.longitude_deg = 8.0;
        fdm.altitude_m = 2000.0;
        fdm.velocity_ned_mps = {north_mps, 0.0, 0.0};
        ASSERT_TRUE(sender_.send_to(net::wire::encode_fgnetfdm24(fdm), to_).has_value());
        ASSERT_TRUE(link_.wait_for_datagram(2s));
    }

    [[nodiscard]] std::optional<TimedEye> eye_at(std::int64_t time_ns) const {
        EyepointReading reading;
        reading.altitude_datum = config::VerticalDatum::Ellipsoid;
        return host_.eye_at(time_ns, reading, {64, 48});
    }

    std::vector<std::string> said_;
    SetClock clock_;
    net::HostLink link_ = net::HostLink::open({"127.0.0.1", 0, ""}).value();
    net::UdpSocket sender_ = net::UdpSocket::bind("127.0.0.1", 0).value();
    net::Endpoint to_ = net::resolve_endpoint("127.0.0.1:" + std::to_string(link_.local_port())).value();
    HeardHost host_{config::Settings{}, link_, clock_,
                    [this](std::string_view line) { said_.emplace_back(line); }};
};

TEST_F(Heard, NothingBeforeThereIsAHost) {
    EXPECT_EQ(host_.hear(), 0U);
    EXPECT_FALSE(eye_at(clock_.now_ns()).has_value());
    EXPECT_EQ(host_.silent_s(), 0.0);
    EXPECT_THAT(said_, IsEmpty());
}

TEST_F(Heard, APacketsArrivalIsTheKernelsOnTheSteadyClock) {
    const std::int64_t before_ns = clock_.now_ns();
    send(46.0, 0.0);
    const std::int64_t sent_ns = clock_.now_ns();
    std::this_thread::sleep_for(50ms);
    EXPECT_EQ(host_.hear(), 1U);
    // The two clocks are read a little apart.
    EXPECT_GE(host_.arrival_ns(), before_ns - 1'000'000);
    EXPECT_LE(host_.arrival_ns(), sent_ns + 1'000'000);
}

TEST_F(Heard, ASystemClockThatIsSetIsToldOnceAndDoesNotSpoilArrivals) {
    send(46.0, 0.0);
    (void)host_.hear();
    clock_.set_by_ns = 3'600'000'000'000;
    const std::int64_t before_ns = clock_.now_ns();
    send(46.1, 0.0);
    (void)host_.hear();
    EXPECT_GE(host_.arrival_ns(), before_ns - 1'000'000);
    EXPECT_LE(host_.arrival_ns(), clock_.now_ns());
    EXPECT_EQ(host_.hear(), 0U);
    EXPECT_THAT(said_, ::testing::Contains(HasSubstr("the system clock was set by +3600.000 s")).Times(1));
}

TEST_F(Heard, TheVehicleIsMovedOnFromItsSecondPacket) {
    send(46.0, 100.0);
    (void)host_.hear();
    std::this_thread::sleep_for(50ms);
    send(46.0 + 5.0 / 111'150.0, 100.0);
    (void)host_.hear();
    const auto eye = eye_at(host_.arrival_ns() + 100'000'000);
    ASSERT_TRUE(eye.has_value());
    EXPECT_NEAR(eye->extrapolated_s, 0.1, 1e-9);
    EXPECT_NEAR((eye->eyepoint.place.latitude_deg - 46.0) * 111'150.0, 15.0, 0.05);
    EXPECT_EQ(eye_at(host_.arrival_ns())->extrapolated_s, 0.0);
}

TEST_F(Heard, AJumpIsTold) {
    send(46.0, 100.0);
    (void)host_.hear();
    std::this_thread::sleep_for(20ms);
    send(47.0, 100.0);
    (void)host_.hear();
    EXPECT_THAT(said_, ElementsAre(HasSubstr("the host's vehicle jumped to 47.00000 8.00000, 2000 m")));
    EXPECT_EQ(eye_at(clock_.now_ns() + 100'000'000)->extrapolated_s, 0.0);
}

TEST_F(Heard, WhatAStopLeftInTheSocketIsReadWhole) {
    for (int i = 0; i < 600; ++i) {
        net::wire::FgNetFdm fdm;
        fdm.latitude_deg = 46.0 + i * 1e-6;
        fdm.longitude_deg = 8.0;
        (void)sender_.send_to(net::wire::encode_fgnetfdm24(fdm), to_);
    }
    ASSERT_TRUE(link_.wait_for_datagram(2s));
    EXPECT_GT(host_.hear(), net::HostLink::kDatagramsPerPoll) << "the kernel kept fewer";
    EXPECT_FALSE(link_.wait_for_datagram(0s));
}

}  // namespace
}  // namespace eyepoint::ig
