#include "ig/hud/hud_lines.hpp"

#include <cmath>

#include <fmt/format.h>

#include "ig/pacing/host_watch.hpp"

namespace eyepoint::ig {

namespace {

std::string_view name_of(config::Pacing pacing) {
    switch (pacing) {
        case config::Pacing::Free:
            return "free";
        case config::Pacing::Host:
            return "by the host";
        case config::Pacing::Fixed:
            break;
    }
    return "fixed";
}

/// 25123 as "25 123".
std::string grouped(std::uint64_t number) {
    std::string digits = std::to_string(number);
    for (std::size_t from_right = 3; from_right < digits.size(); from_right += 4)
        digits.insert(digits.size() - from_right, 1, ' ');
    return digits;
}

std::string host_text(const HudReading& reading) {
    constexpr double kSilenceS = static_cast<double>(HostWatch::kSilenceNs) * 1e-9;
    if (reading.host_silent_s > kSilenceS) return fmt::format("silent for {:.0f} s", reading.host_silent_s);
    return fmt::format("connected, frame {}", reading.entry.host_frame);
}

std::string control_text(const FrameEntry& entry) {
    if (entry.unreachable_share <= 0.0) return std::string(entry.control);
    return fmt::format("{}: {:.0f}% over target", entry.control, 100.0 * entry.unreachable_share);
}

std::string delay_text(const FrameEntry& entry, const HudHistory& history) {
    const auto delay_ms = history.transport_delay_ms();
    if (!delay_ms) return "no packet yet";
    return fmt::format("{:.1f} ms, eye moved on {:.1f} ms", *delay_ms, entry.extrapolated_ms);
}

std::string reused_text(const FrameStatistics& drawn) {
    if (drawn.blocks_tested == 0) return "none tested";
    return fmt::format("{:.1f}% of {} choices", 100.0 * drawn.blocks_reused / drawn.blocks_tested,
                       grouped(drawn.blocks_tested));
}

std::string position_text(const terrain::Geodetic& eye) {
    return fmt::format("{:.5f}° {} {:.5f}° {}", std::abs(eye.latitude_deg),
                       eye.latitude_deg < 0.0 ? 'S' : 'N', std::abs(eye.longitude_deg),
                       eye.longitude_deg < 0.0 ? 'W' : 'E');
}

}  // namespace

std::vector<HudLine> hud_lines(const HudReading& reading, const HudHistory& history) {
    const FrameEntry& entry = reading.entry;
    const FrameStatistics& drawn = entry.drawn;
    constexpr double kBytesPerMib = 1048576.0;
    return {{"control", control_text(entry)},
            {"pacing", fmt::format("{}, {:g} Hz, {} missed", name_of(reading.pacing), reading.rate_hz,
                                   history.missed_deadlines())},
            {"triangles", grouped(drawn.triangles)},
            {"blocks", fmt::format("{} drawn, {} to load", drawn.blocks_drawn, drawn.loads_pending)},
            {"reused", reused_text(drawn)},
            {"uploads", fmt::format("{} blocks, {:.1f} KiB", drawn.blocks_uploaded,
                                    static_cast<double>(drawn.bytes_uploaded) / 1024.0)},
            {"delay", delay_text(entry, history)},
            {"host", host_text(reading)},
            {"memory", fmt::format("{:.0f} MiB", static_cast<double>(reading.resident_bytes) / kBytesPerMib)},
            {"position", position_text(entry.eye)},
            {"height", fmt::format("{:.1f} m above the ellipsoid", entry.eye.height.metres())}};
}

}  // namespace eyepoint::ig
