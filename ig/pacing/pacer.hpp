/// When frames begin, in each of the modes of frame.pacing.
#pragma once

#include <cstdint>
#include <functional>

#include "config/settings.hpp"
#include "ig/frame_clock.hpp"

namespace eyepoint::ig {

/// Says when the frame loop has its next turn, and whether that turn is to draw.
///
/// fixed: a turn at every deadline of the grid of rate_hz (FrameClock).
/// free: the next turn at once after one that drew; after one that did not, with the next packet or deadline.
/// host: a turn with every packet, and one at every deadline of the grid, where Start Of Frame goes out: a
/// synchronous host answers it and so runs at rate_hz. Only what the host has newly said is drawn; while it
/// is silent, a frame every kPatienceNs, so that windows, limits and the end of the run go on.
/// Thread use: one thread.
class Pacer {
  public:
    /// Waits until a packet waits or the clock shows `until_ns`; true for a packet. It may return early.
    using WaitForPacket = std::function<bool(std::int64_t until_ns)>;

    static constexpr std::int64_t kPatienceNs = 250'000'000;

    /// rate_hz: 1..1000. The grid starts now; the first turn is at once.
    Pacer(config::Pacing mode, double rate_hz, Clock& clock, WaitForPacket wait_for_packet);

    /// Waits for the next turn.
    FrameTick wait();
    /// Whether this turn is to draw. `applied`: valid packets that it has heard.
    [[nodiscard]] bool due(unsigned applied);
    /// This turn has drawn.
    void drew() { drew_ = true; }
    /// Starts the grid anew, now, with the slots going on: what was late before is not counted as missed. The
    /// next turn is at once, and due.
    void restart();

  private:
    [[nodiscard]] std::int64_t deadline_ns(std::uint64_t slot) const;
    FrameTick wait_beside_grid();

    config::Pacing mode_;
    Clock& clock_;
    WaitForPacket wait_for_packet_;
    FrameClock grid_;
    double period_ns_;
    std::int64_t start_ns_;
    std::uint64_t start_slot_ = 0;
    std::uint64_t slot_ = 0;  ///< of the newest deadline that had its turn
    std::int64_t last_due_ns_ = 0;
    bool at_once_ = true;
    bool owes_frame_ = true;
    bool drew_ = false;
};

}  // namespace eyepoint::ig
