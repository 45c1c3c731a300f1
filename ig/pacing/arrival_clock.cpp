#include "ig/pacing/arrival_clock.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <limits>

#include "net/nanoseconds.hpp"

namespace eyepoint::ig {

namespace {

constexpr int kTries = 3;
/// The two clocks are read one after the other; stamps may lie this much outside what they bound.
constexpr std::int64_t kSlackNs = 1'000'000;

}  // namespace

ArrivalClock::ArrivalClock(Clock& clock)
    : clock_(clock),
      newest_(read_both()),
      before_(newest_),
      empty_ns_(std::numeric_limits<std::int64_t>::min() / 2),
      last_empty_ns_(empty_ns_) {}

/// The tightest of a few, so that a preemption between the clocks does not look like a step.
ArrivalClock::Reading ArrivalClock::read_both() const {
    Reading best;
    std::int64_t least_ns = std::numeric_limits<std::int64_t>::max();
    for (int i = 0; i < kTries && least_ns > kSlackNs / 10; ++i) {
        const std::int64_t first_ns = clock_.now_ns();
        const std::int64_t system_ns = clock_.realtime_ns();
        const std::int64_t last_ns = clock_.now_ns();
        if (last_ns - first_ns >= least_ns) continue;
        least_ns = last_ns - first_ns;
        best = {last_ns, system_ns - (first_ns + least_ns / 2)};
    }
    return best;
}

std::optional<double> ArrivalClock::read(bool emptied) {
    before_ = newest_;
    newest_ = read_both();
    last_empty_ns_ = empty_ns_;
    if (emptied) empty_ns_ = newest_.steady_ns;
    const std::int64_t step_ns = newest_.ahead_ns - before_.ahead_ns;
    const std::int64_t slewing_ns = (newest_.steady_ns - before_.steady_ns) / 10;
    if (std::abs(step_ns) <= std::max(kLeastStepNs, slewing_ns)) return std::nullopt;
    return static_cast<double>(step_ns) * net::kSecondsPerNanosecond;
}

std::int64_t ArrivalClock::steady_ns(net::ArrivalTime arrival) const {
    for (const Reading& reading : {newest_, before_}) {
        const std::int64_t came_ns = arrival.realtime_ns - reading.ahead_ns;
        if (came_ns < last_empty_ns_ - kSlackNs || came_ns > newest_.steady_ns + kSlackNs) continue;
        return std::clamp(came_ns, last_empty_ns_, newest_.steady_ns);
    }
    return newest_.steady_ns;
}

}  // namespace eyepoint::ig
