#include "ig/pacing/arrival_clock.hpp"

#include <vector>

#include <gtest/gtest.h>

#include "tests/ig/virtual_clock.hpp"

namespace eyepoint::ig {
namespace {

constexpr std::int64_t kMs = 1'000'000;
constexpr std::int64_t kHour = 3'600'000 * kMs;

/// What the kernel would stamp a datagram with now.
net::ArrivalTime stamp(VirtualClock& clock) { return {clock.realtime_ns()}; }

TEST(ArrivalClock, CarriesStampsOverToTheSteadyClock) {
    VirtualClock clock;
    clock.set_realtime(1'700'000'000'000'000'000);
    ArrivalClock arrivals(clock);
    const auto arrival = stamp(clock);
    const std::int64_t came_ns = clock.now_ns();
    clock.work(7 * kMs);
    EXPECT_FALSE(arrivals.read(true).has_value());
    EXPECT_EQ(arrivals.steady_ns(arrival), came_ns);
}

/// A flight of 60 packets a second, read once a frame, with the system clock set in the middle, before or
/// after the packet of that frame: no delay is ever off by more than a frame, nor negative.
TEST(ArrivalClock, AStepNeverMakesADelayAbsurd) {
    for (const std::int64_t step_ns : {kHour, -kHour, 24 * kHour, 50 * kMs, -50 * kMs, 12 * kMs, -12 * kMs}) {
        for (const bool before_packet : {true, false}) {
            VirtualClock clock;
            ArrivalClock arrivals(clock);
            int steps = 0;
            for (int frame = 0; frame < 100; ++frame) {
                if (frame == 50 && before_packet) clock.step_realtime(step_ns);
                const auto arrival = stamp(clock);
                const std::int64_t came_ns = clock.now_ns();
                clock.work(10 * kMs);
                if (frame == 50 && !before_packet) clock.step_realtime(step_ns);
                const auto step_s = arrivals.read(true);
                steps += step_s ? 1 : 0;
                EXPECT_NEAR(step_s.value_or(static_cast<double>(step_ns) * 1e-9),
                            static_cast<double>(step_ns) * 1e-9, 1e-6);
                const std::int64_t delay_ns = clock.now_ns() - arrivals.steady_ns(arrival);
                EXPECT_GE(delay_ns, 0);
                if (frame == 50) {
                    EXPECT_LE(delay_ns, 17 * kMs) << step_ns;
                } else {
                    EXPECT_EQ(arrivals.steady_ns(arrival), came_ns) << step_ns << " frame " << frame;
                }
                clock.work(6 * kMs);
            }
            EXPECT_EQ(steps, 1) << step_ns;
        }
    }
}

TEST(ArrivalClock, AStepOfMoreThanAFrameLeavesItsOwnFramesDelayExact) {
    for (const std::int64_t step_ns : {kHour, -kHour}) {
        VirtualClock clock;
        ArrivalClock arrivals(clock);
        (void)arrivals.read(true);
        const auto arrival = stamp(clock);
        const std::int64_t came_ns = clock.now_ns();
        clock.work(10 * kMs);
        clock.step_realtime(step_ns);
        (void)arrivals.read(true);
        EXPECT_EQ(arrivals.steady_ns(arrival), came_ns);
    }
}

TEST(ArrivalClock, SlewingIsNoStep) {
    VirtualClock clock;
    ArrivalClock arrivals(clock);
    for (int second = 0; second < 100; ++second) {
        clock.work(1'000 * kMs);
        clock.step_realtime(second % 2 == 0 ? 83 * kMs : -83 * kMs);  // chrony's fastest
        EXPECT_FALSE(arrivals.read(true).has_value());
    }
}

TEST(ArrivalClock, WhatWaitedThroughAStopKeepsItsTime) {
    VirtualClock clock;
    ArrivalClock arrivals(clock);
    (void)arrivals.read(true);
    const auto arrival = stamp(clock);
    const std::int64_t came_ns = clock.now_ns();
    clock.work(5'000 * kMs);
    EXPECT_FALSE(arrivals.read(false).has_value());
    EXPECT_EQ(arrivals.steady_ns(arrival), came_ns);
    clock.work(16 * kMs);
    (void)arrivals.read(true);
    EXPECT_EQ(arrivals.steady_ns(arrival), came_ns) << "what the first reading left in the socket";
}

}  // namespace
}  // namespace eyepoint::ig
