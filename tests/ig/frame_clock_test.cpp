#include "ig/frame_clock.hpp"

#include <vector>

#include <gtest/gtest.h>

#include "tests/ig/virtual_clock.hpp"

namespace eyepoint::ig {
namespace {

constexpr std::int64_t kMs = 1'000'000;

TEST(FrameClock, FirstTickIsAtOnce) {
    VirtualClock clock;
    FrameClock frames(clock, 60.0);
    const std::int64_t start_ns = clock.now_ns();
    const FrameTick tick = frames.wait();
    EXPECT_EQ(tick.slot, 0U);
    EXPECT_EQ(tick.missed, 0U);
    EXPECT_EQ(clock.now_ns(), start_ns);
}

TEST(FrameClock, DoesNotDriftOverAnHourAtARateWithoutAWholePeriod) {
    VirtualClock clock;
    clock.wake_up_ns = 57'000;
    FrameClock frames(clock, 60.0);
    const std::int64_t start_ns = clock.now_ns();
    FrameTick tick;
    for (int frame = 0; frame <= 60 * 3600; ++frame) {
        tick = frames.wait();
        clock.work(5 * kMs);
    }
    EXPECT_EQ(tick.slot, 60U * 3600U);
    EXPECT_EQ(tick.deadline_ns - start_ns, 3'600'000'000'000);
}

TEST(FrameClock, EveryDeadlineIsTheRoundedGridPoint) {
    VirtualClock clock;
    FrameClock frames(clock, 30.0);
    const std::int64_t start_ns = clock.now_ns();
    const std::vector<std::int64_t> expected_ns{0, 33'333'333, 66'666'667, 100'000'000, 133'333'333};
    for (const std::int64_t expected : expected_ns) EXPECT_EQ(frames.wait().deadline_ns - start_ns, expected);
}

TEST(FrameClock, ALateFrameTakesTheNextDeadlineAheadAndCountsTheOnesPassed) {
    VirtualClock clock;
    FrameClock frames(clock, 100.0);
    frames.wait();
    clock.work(35 * kMs);  // over the deadlines of slots 1, 2 and 3
    const FrameTick tick = frames.wait();
    EXPECT_EQ(tick.slot, 4U);
    EXPECT_EQ(tick.missed, 3U);
    EXPECT_EQ(clock.now_ns(), tick.deadline_ns);
}

TEST(FrameClock, AStallOfSecondsCausesNoBurst) {
    VirtualClock clock;
    FrameClock frames(clock, 60.0);
    frames.wait();
    clock.work(2'000 * kMs + 1);
    frames.wait();
    std::int64_t before_ns = clock.now_ns();
    for (int frame = 0; frame < 100; ++frame) {
        EXPECT_EQ(frames.wait().missed, 0U);
        EXPECT_GE(clock.now_ns() - before_ns, 16 * kMs);
        before_ns = clock.now_ns();
    }
}

TEST(FrameClock, AProcessStoppedInItsSleepBeginsAtTheNewestDeadlinePassed) {
    VirtualClock clock;
    FrameClock frames(clock, 100.0);
    frames.wait();
    clock.wake_up_ns = 5'003 * kMs;
    const FrameTick tick = frames.wait();
    clock.wake_up_ns = 0;
    EXPECT_EQ(tick.slot, 501U);
    EXPECT_EQ(tick.missed, 500U);
    EXPECT_EQ(clock.now_ns() - tick.deadline_ns, 3 * kMs);
    EXPECT_EQ(frames.wait().missed, 0U);
    EXPECT_EQ(frames.wait().slot, 503U);
}

TEST(FrameClock, WorkThatEndsOnTheDeadlineIsInTime) {
    VirtualClock clock;
    FrameClock frames(clock, 100.0);
    frames.wait();
    clock.work(10 * kMs);
    const FrameTick tick = frames.wait();
    EXPECT_EQ(tick.slot, 1U);
    EXPECT_EQ(tick.missed, 0U);
}

TEST(FrameClock, RestartForgetsWhatWasLate) {
    VirtualClock clock;
    FrameClock frames(clock, 100.0);
    frames.wait();
    clock.work(1'234 * kMs);
    frames.restart();
    const std::int64_t restart_ns = clock.now_ns();
    const FrameTick tick = frames.wait();
    EXPECT_EQ(tick.slot, 1U);
    EXPECT_EQ(tick.missed, 0U);
    EXPECT_EQ(tick.deadline_ns, restart_ns);
    EXPECT_EQ(frames.wait().deadline_ns, restart_ns + 10 * kMs);
}

TEST(SystemClock, SleepsUntilTheDeadlineAndNotLess) {
    SystemClock clock;
    const std::int64_t deadline_ns = clock.now_ns() + 3 * kMs;
    clock.sleep_until(deadline_ns);
    EXPECT_GE(clock.now_ns(), deadline_ns);
}

TEST(SystemClock, ADeadlineInThePastDoesNotWait) {
    SystemClock clock;
    const std::int64_t begin_ns = clock.now_ns();
    clock.sleep_until(begin_ns - 5'000 * kMs);
    EXPECT_LT(clock.now_ns() - begin_ns, 1'000 * kMs);
}

}  // namespace
}  // namespace eyepoint::ig
