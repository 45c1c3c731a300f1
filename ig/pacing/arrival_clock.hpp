/// Arrival times of datagrams on the steady clock, whatever is done to the system's time.
#pragma once

#include <cstdint>
#include <optional>

#include "ig/frame_clock.hpp"
#include "net/host_state.hpp"

namespace eyepoint::ig {

/// The kernel stamps datagrams with the system's time (CLOCK_REALTIME), which people and time servers set.
/// Both clocks are read together after each reading of the socket; their difference carries the stamps over.
/// A stamp that this puts after the reading, or before the socket was last found empty, was made before a
/// step: then the difference from before it is tried, and last the time of reading is taken. So whatever the
/// step, an arrival is wrong by no more than the time between two readings. Thread use: one thread.
class ArrivalClock {
  public:
    /// A difference that changes by more than this, and by a tenth of the time between two readings, is a
    /// step; less is a time server's slewing.
    static constexpr std::int64_t kLeastStepNs = 10'000'000;

    explicit ArrivalClock(Clock& clock);

    /// Reads both clocks: after the socket has been read, before steady_ns(). `emptied`: nothing was left in
    /// it. Gives the step since the last time, seconds, where there was one.
    std::optional<double> read(bool emptied);

    /// When a datagram of this reading came, nanoseconds of the steady clock, no later than the reading.
    [[nodiscard]] std::int64_t steady_ns(net::ArrivalTime arrival) const;

  private:
    struct Reading {
        std::int64_t steady_ns = 0;
        std::int64_t ahead_ns = 0;  ///< of the system's time on the steady clock
    };
    [[nodiscard]] Reading read_both() const;

    Clock& clock_;
    Reading newest_, before_;
    std::int64_t empty_ns_ = 0;       ///< when the socket was last found empty
    std::int64_t last_empty_ns_ = 0;  ///< when before this reading
};

}  // namespace eyepoint::ig
