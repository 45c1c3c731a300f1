/// The last frames, for the HUD's graphs.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "ig/frame_record.hpp"

namespace eyepoint::ig {

/// Of the last kFrames frames; its memory does not grow. Thread use: one thread.
class HudHistory {
  public:
    static constexpr std::size_t kFrames = 240;
    using Ring = std::array<float, kFrames>;

    void add(const FrameEntry& entry);

    /// Milliseconds and pixels; the oldest frame is at oldest(). Zeros for frames that have not been yet.
    [[nodiscard]] const Ring& frame_ms() const { return frame_ms_; }
    [[nodiscard]] const Ring& tau_px() const { return tau_px_; }
    [[nodiscard]] std::size_t oldest() const { return next_; }

    [[nodiscard]] double slowest_frame_ms() const;
    [[nodiscard]] double greatest_tau_px() const;
    [[nodiscard]] std::uint64_t missed_deadlines() const;
    /// Of the last frame that drew a new packet, from its arrival to the whole picture.
    [[nodiscard]] std::optional<double> transport_delay_ms() const { return transport_delay_ms_; }

  private:
    Ring frame_ms_{}, tau_px_{};
    std::array<std::uint64_t, kFrames> missed_{};
    std::size_t next_ = 0;
    std::optional<double> transport_delay_ms_;
};

}  // namespace eyepoint::ig
