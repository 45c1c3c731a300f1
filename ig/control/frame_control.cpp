#include "ig/control/frame_control.hpp"

#include <fmt/format.h>

namespace eyepoint::ig {

namespace {

/// With more blocks missing than this share of the drawn ones, what is drawn is not what tau asks for.
constexpr double kAwaitedShare = 0.125;

bool controlled(const config::Settings& settings) {
    switch (settings.control.tolerance) {
        case config::TauControl::On:
            return true;
        case config::TauControl::Off:
            return false;
        case config::TauControl::Automatic:
            break;
    }
    return settings.output.kind == config::OutputKind::Window &&
           settings.frame.pacing != config::Pacing::Free;
}

std::string unreachable_line(const ControlDecision& decision, const ControlTarget& target) {
    const std::string over = fmt::format("frames take {:.0f}% more than the {:.1f} ms they may",
                                         100.0 * decision.unreachable_share, target.frame_ms);
    constexpr const char* kRemedy = "lower frame.rate_hz or the size of the picture";
    if (decision.state == ControlState::Coarsest)
        return fmt::format("{} at the coarsest tolerance, {:g} px: target unreachable; {}", over,
                           target.tau_max_px, kRemedy);
    return fmt::format("{}, next to nothing of it for terrain: tolerance held at {:.2f} px; {}", over,
                       decision.tau_px, kRemedy);
}

}  // namespace

tl::expected<std::optional<ControlTarget>, std::string> control_target(const config::Settings& settings) {
    if (!controlled(settings)) return std::nullopt;
    const config::ControlSettings& control = settings.control;
    if (control.tau_min_px > control.tau_max_px)
        return tl::unexpected(fmt::format(
            "control.tau_min_px is {} and control.tau_max_px is {}; the least tolerance cannot be "
            "above the greatest",
            control.tau_min_px, control.tau_max_px));
    return ControlTarget{.frame_ms = 1e3 * control.target_share / settings.frame.rate_hz,
                         .tau_min_px = control.tau_min_px,
                         .tau_max_px = control.tau_max_px,
                         .nominal_tau_px = settings.terrain.tau_px};
}

FrameCost cost_of(const FrameEntry& entry) {
    const FrameStatistics& drawn = entry.drawn;
    return {.tau_px = drawn.tau_px,
            .triangles = static_cast<double>(drawn.triangles),
            .cost_ms = entry.frame_ms,
            .other_ms = entry.output_ms,
            .awaits_terrain = drawn.loads_pending > kAwaitedShare * drawn.blocks_drawn};
}

std::optional<std::string> ControlLog::line(const ControlDecision& decision, std::int64_t now_ns) {
    const bool unreachable = decision.state == ControlState::Coarsest || decision.state == ControlState::Held;
    const bool news = unreachable != said_unreachable_;
    if (!news) state_since_ns_.reset();
    if (news && !state_since_ns_) state_since_ns_ = now_ns;
    const bool again = unreachable && last_line_ns_ && now_ns - *last_line_ns_ >= kQuietNs;
    if (news ? now_ns - *state_since_ns_ < kPatienceNs : !again) return std::nullopt;
    said_unreachable_ = unreachable;
    state_since_ns_.reset();
    last_line_ns_ = now_ns;
    if (unreachable) return unreachable_line(decision, target_);
    return fmt::format("frames keep to the {:.1f} ms they may take again, at a tolerance of {:.2f} px",
                       target_.frame_ms, decision.tau_px);
}

}  // namespace eyepoint::ig
