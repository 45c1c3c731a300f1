/// What the HUD says, in words.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "config/settings.hpp"
#include "ig/frame_record.hpp"
#include "ig/hud/hud_history.hpp"

namespace eyepoint::ig {

/// The last whole frame, and what stood around it.
struct HudReading {
    FrameEntry entry;
    config::Pacing pacing = config::Pacing::Fixed;
    double rate_hz = 60.0;
    double host_silent_s = 0.0;        ///< since its last valid packet
    std::uint64_t resident_bytes = 0;  ///< of the process, now
};

struct HudLine {
    std::string_view label;  ///< static storage
    std::string text;        ///< value with its unit
};

inline constexpr std::size_t kHudLines = 11;

/// kHudLines lines, always in the same order. Text is Latin-1 in UTF-8.
[[nodiscard]] std::vector<HudLine> hud_lines(const HudReading& reading, const HudHistory& history);

}  // namespace eyepoint::ig
