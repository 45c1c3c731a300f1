/// Frame pacing: absolute deadlines on a grid of a fixed rate.
#pragma once

#include <cstdint>

namespace eyepoint::ig {

/// The time that the frame loop lives in; a seam, so that tests and replay in virtual time need not wait.
class Clock {
  public:
    virtual ~Clock() = default;
    /// Nanoseconds of a clock that never steps; its zero means nothing.
    [[nodiscard]] virtual std::int64_t now_ns() = 0;
    /// Nanoseconds since 1970, the time that datagrams are stamped with; may step.
    [[nodiscard]] virtual std::int64_t realtime_ns() = 0;
    /// Returns at or after `deadline_ns` of now_ns(); at once if that is past.
    virtual void sleep_until(std::int64_t deadline_ns) = 0;
};

/// CLOCK_MONOTONIC, CLOCK_REALTIME and clock_nanosleep with an absolute deadline. Thread use: any.
class SystemClock final : public Clock {
  public:
    [[nodiscard]] std::int64_t now_ns() override;
    [[nodiscard]] std::int64_t realtime_ns() override;
    void sleep_until(std::int64_t deadline_ns) override;
};

/// One beat of the frame clock.
struct FrameTick {
    std::uint64_t slot = 0;        ///< place on the grid: deadline = start + slot / rate
    std::int64_t deadline_ns = 0;  ///< when the frame was to start
    std::uint64_t missed = 0;      ///< deadlines passed over since the tick before
    bool on_grid = true;           ///< a deadline; otherwise a packet's arrival
};

/// Deadlines are start + slot / rate, each computed from the slot, so nothing adds up: no drift. A frame that
/// is late takes the next deadline still ahead; the ones between are missed and never made up for: no burst.
/// A process that wakes periods late (it was stopped) begins at once, at the newest deadline passed.
/// Thread use: one thread.
class FrameClock {
  public:
    /// rate_hz: 1..1000. The grid starts now; the first tick is slot 0, at once.
    FrameClock(Clock& clock, double rate_hz);

    /// Sleeps until the next deadline.
    FrameTick wait();
    /// Starts the grid anew, now, with the slots going on: what was late before is not counted as missed.
    void restart();

  private:
    [[nodiscard]] std::int64_t deadline_ns(std::uint64_t slot) const;
    void pass_over(FrameTick& tick, double periods) const;

    Clock& clock_;
    double period_ns_;
    std::int64_t start_ns_;
    std::uint64_t start_slot_ = 0;
    std::uint64_t next_slot_ = 0;
};

}  // namespace eyepoint::ig
