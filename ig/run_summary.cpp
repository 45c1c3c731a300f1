#include "ig/run_summary.hpp"

#include <fmt/format.h>

namespace eyepoint::ig {

void RunSummary::add(const FrameEntry& entry) {
    frame_ms_.add(entry.frame_ms);
    if (entry.new_packet) delay_ms_.add(entry.arrival_to_complete_ms);
    triangles_.add(static_cast<double>(entry.drawn.triangles));
    missed_deadlines_ += entry.missed_deadlines;
}

std::string RunSummary::line(double seconds, const net::SessionCounters& host,
                             std::uint64_t peak_bytes) const {
    const double rate_hz = seconds > 0.0 ? static_cast<double>(frames()) / seconds : 0.0;
    const std::string drops = describe_drops(host);
    return fmt::format(
        "{} frames in {:.1f} s ({:.1f} Hz); frame ms p50 {:.2f} p95 {:.2f} p99 {:.2f} max {:.2f}; {} missed "
        "deadlines; "
        "delay ms p50 {:.2f} p95 {:.2f} p99 {:.2f} max {:.2f}; {} packets{}{}; triangles median {:.0f}; peak "
        "memory {} MiB",
        frames(), seconds, rate_hz, frame_ms_.percentile(0.50), frame_ms_.percentile(0.95),
        frame_ms_.percentile(0.99), frame_ms_.maximum(), missed_deadlines_, delay_ms_.percentile(0.50),
        delay_ms_.percentile(0.95), delay_ms_.percentile(0.99), delay_ms_.maximum(), host.datagrams,
        drops.empty() ? "" : ", ", drops, triangles_.percentile(0.50), peak_bytes >> 20);
}

std::string describe_drops(const net::SessionCounters& counters) {
    if (counters.dropped_total() == 0) return {};
    std::string reasons;
    for (std::size_t i = 0; i < counters.dropped.size(); ++i) {
        if (counters.dropped[i] == 0) continue;
        reasons += fmt::format("{} {} {}", reasons.empty() ? ":" : ",", counters.dropped[i],
                               net::name(static_cast<net::DropReason>(i)));
    }
    return fmt::format("{} dropped{}", counters.dropped_total(), reasons);
}

}  // namespace eyepoint::ig
