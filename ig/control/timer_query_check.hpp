/// Whether OpenGL's timer queries can be believed here.
#pragma once

#include <functional>
#include <optional>
#include <string>

namespace eyepoint::ig {

/// One piece of work by both clocks, medians of a few times.
struct TimerQueryCheck {
    double query_ms = 0.0;  ///< GL_TIME_ELAPSED
    double fence_ms = 0.0;  ///< monotonic clock, from an idle GPU to the fence behind the work
    bool agrees = false;    ///< within kTimerAgreement, where the work takes long enough to tell
};

/// The fence's time has the way to the driver and back in it, so a query may be this share shorter.
inline constexpr double kTimerAgreement = 0.25;

/// Times `draw`, which issues OpenGL commands. None where the context has no timer queries (no bits, or they
/// never answer). On Mesa's software renderer queries see a fraction of the work, and do not agree. Needs a
/// current context; its thread.
[[nodiscard]] std::optional<TimerQueryCheck> check_timer_queries(const std::function<void()>& draw);

/// Pure: agreement of two times.
[[nodiscard]] bool timers_agree(double query_ms, double fence_ms);

/// For the log: "GL timer queries say 3.1 ms of 27.9: fences are used".
[[nodiscard]] std::string describe(const std::optional<TimerQueryCheck>& check);

}  // namespace eyepoint::ig
