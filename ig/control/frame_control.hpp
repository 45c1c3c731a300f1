/// Tolerance control of a channel: from its settings to what is said in the log.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <tl/expected.hpp>

#include "config/settings.hpp"
#include "ig/control/tolerance_controller.hpp"
#include "ig/frame_record.hpp"

namespace eyepoint::ig {

/// What the settings ask for; none where the tolerance is to stand. On failure (the bounds the wrong way
/// round): one sentence.
[[nodiscard]] tl::expected<std::optional<ControlTarget>, std::string> control_target(
    const config::Settings& settings);

/// A drawn frame as the controller takes it: cost by fence and monotonic clock, the output beside it.
[[nodiscard]] FrameCost cost_of(const FrameEntry& entry);

/// Says that the target cannot be met once that has lasted a second, again every minute, and when it is met
/// again. Thread use: one thread.
class ControlLog {
  public:
    static constexpr std::int64_t kPatienceNs = 1'000'000'000;
    static constexpr std::int64_t kQuietNs = 60'000'000'000;

    explicit ControlLog(const ControlTarget& target) : target_(target) {}

    /// The line due now, if any. `now_ns`: of a clock that never steps.
    [[nodiscard]] std::optional<std::string> line(const ControlDecision& decision, std::int64_t now_ns);

  private:
    ControlTarget target_;
    std::optional<std::int64_t> state_since_ns_;  ///< unreachable, or met again, against what was said last
    std::optional<std::int64_t> last_line_ns_;
    bool said_unreachable_ = false;
};

}  // namespace eyepoint::ig
