#include "ig/pacing/pacer.hpp"

#include <cmath>
#include <utility>

#include "net/nanoseconds.hpp"

namespace eyepoint::ig {

namespace {}

Pacer::Pacer(config::Pacing mode, double rate_hz, Clock& clock, WaitForPacket wait_for_packet)
    : mode_(mode),
      clock_(clock),
      wait_for_packet_(std::move(wait_for_packet)),
      grid_(clock, rate_hz),
      period_ns_(net::kNanosecondsPerSecond / rate_hz),
      start_ns_(clock.now_ns()) {}

std::int64_t Pacer::deadline_ns(std::uint64_t slot) const {
    return start_ns_ + std::llround(static_cast<double>(slot - start_slot_) * period_ns_);
}

FrameTick Pacer::wait() {
    const bool drew = std::exchange(drew_, false);
    if (mode_ == config::Pacing::Fixed) return grid_.wait();
    const bool runs_free = mode_ == config::Pacing::Free && drew;
    if (!std::exchange(at_once_, false) && !runs_free) {
        const std::int64_t until_ns = deadline_ns(slot_ + 1);
        if (clock_.now_ns() < until_ns) (void)wait_for_packet_(until_ns);
    }
    return wait_beside_grid();
}

FrameTick Pacer::wait_beside_grid() {
    const std::int64_t now_ns = clock_.now_ns();
    auto passed =
        static_cast<std::uint64_t>(static_cast<double>(now_ns - start_ns_) / period_ns_) + start_slot_;
    // Deadlines are rounded to the nanosecond, down too.
    if (deadline_ns(passed + 1) <= now_ns) ++passed;
    const bool on_grid = mode_ == config::Pacing::Free || passed > slot_ || owes_frame_;
    slot_ = passed;
    return {.slot = passed, .deadline_ns = now_ns, .missed = 0, .on_grid = on_grid};
}

bool Pacer::due(unsigned applied) {
    const std::int64_t now_ns = clock_.now_ns();
    if (mode_ == config::Pacing::Host && applied == 0 && !owes_frame_ && now_ns - last_due_ns_ < kPatienceNs)
        return false;
    last_due_ns_ = now_ns;
    owes_frame_ = false;
    return true;
}

void Pacer::restart() {
    grid_.restart();
    start_ns_ = clock_.now_ns();
    start_slot_ = slot_;
    at_once_ = true;
    owes_frame_ = true;
}

}  // namespace eyepoint::ig
