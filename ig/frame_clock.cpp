#include "ig/frame_clock.hpp"

#include <cerrno>
#include <cmath>
#include <ctime>

#include "net/nanoseconds.hpp"

namespace eyepoint::ig {

namespace {

std::int64_t read_clock_ns(clockid_t id) {
    timespec now{};
    clock_gettime(id, &now);
    return now.tv_sec * net::kNanosecondsPerSecond + now.tv_nsec;
}

}  // namespace

std::int64_t SystemClock::now_ns() { return read_clock_ns(CLOCK_MONOTONIC); }

std::int64_t SystemClock::realtime_ns() { return read_clock_ns(CLOCK_REALTIME); }

void SystemClock::sleep_until(std::int64_t deadline_ns) {
    const timespec deadline{deadline_ns / net::kNanosecondsPerSecond,
                            deadline_ns % net::kNanosecondsPerSecond};
    while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &deadline, nullptr) == EINTR) {
    }
}

FrameClock::FrameClock(Clock& clock, double rate_hz)
    : clock_(clock), period_ns_(net::kNanosecondsPerSecond / rate_hz), start_ns_(clock.now_ns()) {}

std::int64_t FrameClock::deadline_ns(std::uint64_t slot) const {
    return start_ns_ + std::llround(static_cast<double>(slot - start_slot_) * period_ns_);
}

void FrameClock::pass_over(FrameTick& tick, double periods) const {
    const auto whole = static_cast<std::uint64_t>(periods);
    tick.missed += whole;
    tick.slot += whole;
    tick.deadline_ns = deadline_ns(tick.slot);
}

FrameTick FrameClock::wait() {
    FrameTick tick{.slot = next_slot_, .deadline_ns = deadline_ns(next_slot_)};
    const auto periods_late = [&] {
        return static_cast<double>(clock_.now_ns() - tick.deadline_ns) / period_ns_;
    };
    if (tick.slot > start_slot_ && periods_late() > 0.0) pass_over(tick, std::ceil(periods_late()));
    clock_.sleep_until(tick.deadline_ns);
    if (periods_late() >= 1.0) pass_over(tick, std::floor(periods_late()));
    next_slot_ = tick.slot + 1;
    return tick;
}

void FrameClock::restart() {
    start_ns_ = clock_.now_ns();
    start_slot_ = next_slot_;
}

}  // namespace eyepoint::ig
