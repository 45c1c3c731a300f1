/// A clock for tests: time passes only when somebody sleeps or works.
#pragma once

#include <algorithm>
#include <cstdint>

#include "ig/frame_clock.hpp"

namespace eyepoint::ig {

class VirtualClock final : public Clock {
  public:
    std::int64_t now_ns() override { return now_ns_; }
    std::int64_t realtime_ns() override { return now_ns_ + realtime_ahead_ns_; }
    void sleep_until(std::int64_t deadline_ns) override {
        now_ns_ = std::max(now_ns_, deadline_ns + wake_up_ns);
    }

    void work(std::int64_t ns) { now_ns_ += ns; }
    /// The system's time is set, to or by so much; the steady time knows nothing of it.
    void set_realtime(std::int64_t ns) { realtime_ahead_ns_ = ns - now_ns_; }
    void step_realtime(std::int64_t by_ns) { realtime_ahead_ns_ += by_ns; }

    std::int64_t wake_up_ns = 0;  ///< how late every sleep ends

  private:
    std::int64_t now_ns_ = 1'000'000'007;
    std::int64_t realtime_ahead_ns_ = 0;
};

}  // namespace eyepoint::ig
