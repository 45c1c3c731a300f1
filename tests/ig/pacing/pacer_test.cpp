#include "ig/pacing/pacer.hpp"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "tests/ig/virtual_clock.hpp"

namespace eyepoint::ig {
namespace {

using config::Pacing;

constexpr std::int64_t kMs = 1'000'000;

/// A host that sends a packet at each of these times, and a loop that hears it.
class Host {
  public:
    Host(VirtualClock& clock, std::vector<std::int64_t> packets_ns)
        : clock_(clock), packets_ns_(std::move(packets_ns)) {}

    /// From now on, one every so often, for so long.
    static std::vector<std::int64_t> every(VirtualClock& clock, std::int64_t period_ns, std::int64_t for_ns) {
        std::vector<std::int64_t> times;
        for (std::int64_t ns = 0; ns < for_ns; ns += period_ns) times.push_back(clock.now_ns() + ns);
        return times;
    }

    Pacer::WaitForPacket wait() {
        return [this](std::int64_t until_ns) {
            const bool comes = heard_ < packets_ns_.size() && packets_ns_[heard_] <= until_ns;
            clock_.sleep_until(comes ? packets_ns_[heard_] : until_ns);
            return comes;
        };
    }
    unsigned hear() {
        const std::size_t before = heard_;
        while (heard_ < packets_ns_.size() && packets_ns_[heard_] <= clock_.now_ns()) ++heard_;
        return static_cast<unsigned>(heard_ - before);
    }
    /// How old the newest packet heard is.
    [[nodiscard]] std::int64_t age_ns() const { return clock_.now_ns() - packets_ns_[heard_ - 1]; }

  private:
    VirtualClock& clock_;
    std::vector<std::int64_t> packets_ns_;
    std::size_t heard_ = 0;
};

struct Flown {
    int turns = 0, frames = 0, answers = 0;
    std::int64_t oldest_ns = 0;  ///< packet, when its frame began
};

/// Turns until the time is over; every due one draws for `frame_ns`.
Flown fly(Pacer& pacer, Host& host, VirtualClock& clock, std::int64_t for_ns, std::int64_t frame_ns) {
    Flown flown;
    const std::int64_t end_ns = clock.now_ns() + for_ns;
    while (clock.now_ns() < end_ns) {
        const FrameTick tick = pacer.wait();
        const unsigned applied = host.hear();
        ++flown.turns;
        flown.answers += tick.on_grid ? 1 : 0;
        if (!pacer.due(applied)) continue;
        ++flown.frames;
        if (applied > 0) flown.oldest_ns = std::max(flown.oldest_ns, host.age_ns());
        clock.work(frame_ns);
        pacer.drew();
    }
    return flown;
}

TEST(Pacer, FixedDrawsAtEveryDeadlineForAnHourWithoutDrift) {
    VirtualClock clock;
    clock.wake_up_ns = 60'000;
    Host silent(clock, {});
    const std::int64_t start_ns = clock.now_ns();
    Pacer pacer(Pacing::Fixed, 60.0, clock, silent.wait());
    FrameTick tick;
    for (int frame = 0; frame <= 60 * 3600; ++frame) {
        tick = pacer.wait();
        ASSERT_TRUE(tick.on_grid && pacer.due(0));
        clock.work(5 * kMs);
        pacer.drew();
    }
    EXPECT_EQ(tick.deadline_ns - start_ns, 3'600'000'000'000);
}

TEST(Pacer, FreeDrawsOneFrameAfterAnother) {
    VirtualClock clock;
    Host silent(clock, {});
    Pacer pacer(Pacing::Free, 60.0, clock, silent.wait());
    EXPECT_EQ(fly(pacer, silent, clock, 1000 * kMs, 4 * kMs).frames, 250);
}

TEST(Pacer, FreeDoesNotSpinWhileThereIsNothingToDraw) {
    VirtualClock clock;
    Host silent(clock, {});
    Pacer pacer(Pacing::Free, 50.0, clock, silent.wait());
    const std::int64_t start_ns = clock.now_ns();
    for (int turn = 0; turn <= 50; ++turn) (void)pacer.wait();
    EXPECT_EQ(clock.now_ns() - start_ns, 1000 * kMs);
}

TEST(Pacer, HostDrawsEachOfItsPacketsAsItComes) {
    for (const int rate_hz : {1, 10, 30, 50, 60, 100}) {
        VirtualClock clock;
        Host host(clock, Host::every(clock, 1000 * kMs / rate_hz, 10'000 * kMs));
        Pacer pacer(Pacing::Host, 60.0, clock, host.wait());
        const Flown flown = fly(pacer, host, clock, 10'000 * kMs, 3 * kMs);
        // At 1 Hz three more a second, so that windows live on.
        const int expected = rate_hz == 1 ? 10 * 4 : 10 * rate_hz;
        EXPECT_NEAR(flown.frames, expected, rate_hz == 1 ? 4 : 1) << rate_hz;
        EXPECT_NEAR(flown.answers, 600, 2) << rate_hz;
        EXPECT_EQ(flown.oldest_ns, 0) << rate_hz;
    }
}

TEST(Pacer, AHostFasterThanTheFramesHasItsNewestPacketDrawn) {
    VirtualClock clock;
    Host host(clock, Host::every(clock, kMs, 2'000 * kMs));
    Pacer pacer(Pacing::Host, 60.0, clock, host.wait());
    const Flown flown = fly(pacer, host, clock, 2'000 * kMs, 5 * kMs + 300'000);
    EXPECT_NEAR(flown.frames, 2'000 / 5.3, 25);
    EXPECT_LT(flown.oldest_ns, kMs);
}

TEST(Pacer, ASilentHostStillGetsAFrameNowAndThenAndItsStartOfFrames) {
    VirtualClock clock;
    Host silent(clock, {});
    Pacer pacer(Pacing::Host, 60.0, clock, silent.wait());
    const Flown flown = fly(pacer, silent, clock, 10'000 * kMs, 3 * kMs);
    EXPECT_NEAR(flown.frames, 10'000 * kMs / Pacer::kPatienceNs, 3);
    EXPECT_NEAR(flown.answers, 600, 2);
}

/// Synchronous CIGI: the host answers each Start Of Frame, 1 ms later.
TEST(Pacer, ASynchronousHostRunsAtTheFrameRate) {
    VirtualClock clock;
    std::int64_t answer_ns = 0;
    Pacer pacer(Pacing::Host, 60.0, clock, [&](std::int64_t until_ns) {
        const bool comes = answer_ns != 0 && answer_ns <= until_ns;
        clock.sleep_until(comes ? answer_ns : until_ns);
        return comes;
    });
    int frames = 0, drawn_packets = 0;
    const std::int64_t end_ns = clock.now_ns() + 10'000 * kMs;
    while (clock.now_ns() < end_ns) {
        const FrameTick tick = pacer.wait();
        const bool heard = answer_ns != 0 && answer_ns <= clock.now_ns();
        if (heard) answer_ns = 0;
        if (tick.on_grid) answer_ns = clock.now_ns() + kMs;
        if (!pacer.due(heard ? 1 : 0)) continue;
        ++frames;
        drawn_packets += heard ? 1 : 0;
        clock.work(8 * kMs);
        pacer.drew();
    }
    EXPECT_NEAR(frames, 600, 3);
    EXPECT_NEAR(drawn_packets, 600, 3);
}

TEST(Pacer, NoModeMakesUpForAStop) {
    for (const Pacing mode : {Pacing::Fixed, Pacing::Free, Pacing::Host}) {
        VirtualClock clock;
        Host host(clock, Host::every(clock, 10 * kMs, 8'000 * kMs));
        Pacer pacer(mode, 100.0, clock, host.wait());
        (void)fly(pacer, host, clock, 1'000 * kMs, 2 * kMs);
        clock.work(5'000 * kMs);
        const Flown flown = fly(pacer, host, clock, 1'000 * kMs, 2 * kMs);
        const int expected = mode == Pacing::Free ? 500 : 100;
        EXPECT_NEAR(flown.frames, expected, 2) << static_cast<int>(mode);
    }
}

TEST(Pacer, RestartOwesAFrameAtOnce) {
    for (const Pacing mode : {Pacing::Fixed, Pacing::Free, Pacing::Host}) {
        VirtualClock clock;
        Host silent(clock, {});
        Pacer pacer(mode, 60.0, clock, silent.wait());
        (void)fly(pacer, silent, clock, 500 * kMs, kMs);
        clock.work(3'333 * kMs);
        pacer.restart();
        const std::int64_t restart_ns = clock.now_ns();
        const FrameTick tick = pacer.wait();
        EXPECT_EQ(clock.now_ns(), restart_ns);
        EXPECT_EQ(tick.missed, 0U);
        EXPECT_TRUE(pacer.due(0));
    }
}

}  // namespace
}  // namespace eyepoint::ig
