#include "ig/hud/hud_history.hpp"

#include <algorithm>
#include <numeric>

namespace eyepoint::ig {

void HudHistory::add(const FrameEntry& entry) {
    frame_ms_[next_] = static_cast<float>(entry.frame_ms);
    tau_px_[next_] = static_cast<float>(entry.drawn.tau_px);
    missed_[next_] = entry.missed_deadlines;
    next_ = (next_ + 1) % kFrames;
    if (entry.new_packet) transport_delay_ms_ = entry.arrival_to_complete_ms;
}

double HudHistory::slowest_frame_ms() const { return *std::ranges::max_element(frame_ms_); }

double HudHistory::greatest_tau_px() const { return *std::ranges::max_element(tau_px_); }

std::uint64_t HudHistory::missed_deadlines() const {
    return std::accumulate(missed_.begin(), missed_.end(), std::uint64_t{0});
}

}  // namespace eyepoint::ig
