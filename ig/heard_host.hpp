/// The host as the frame loop knows it: heard, its packets timed, its vehicle moved on.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>

#include "config/settings.hpp"
#include "ig/drop_log.hpp"
#include "ig/eyepoint.hpp"
#include "ig/frame_clock.hpp"
#include "ig/motion/host_motion.hpp"
#include "ig/pacing/arrival_clock.hpp"
#include "ig/pacing/host_watch.hpp"
#include "net/host_link.hpp"

namespace eyepoint::ig {

/// The eye of one frame, and what it was made from.
struct TimedEye {
    Eyepoint eyepoint;
    std::int64_t arrival_ns = 0;  ///< of the packet, on the steady clock
    double extrapolated_s = 0.0;  ///< how far the vehicle was moved on from it; 0: not at all
};

/// Takes what waits at the socket, times and follows it, and says on `warn` what is odd: bad packets, a
/// silent, slow or fast host, a vehicle that jumps, a system clock that is set. Thread use: one thread.
class HeardHost {
  public:
    using Warn = std::function<void(std::string_view)>;

    /// A flood is read for this long a turn at the most.
    static constexpr std::int64_t kHearingNs = 2'000'000;

    /// Link and clock outlive it.
    HeardHost(const config::Settings& settings, net::HostLink& link, Clock& clock, Warn warn);

    /// Reads the socket until it is empty. Gives the number of valid packets.
    unsigned hear();

    /// The eye that the newest state asks for at a time of the steady clock, or nothing while the host has
    /// not placed the vehicle. Without extrapolation (host.extrapolation) the newest packet's own.
    [[nodiscard]] std::optional<TimedEye> eye_at(std::int64_t time_ns, const EyepointReading& reading,
                                                 PictureSize size) const;

    /// nullptr until the host has spoken validly.
    [[nodiscard]] const net::HostState* state() const { return link_.state(); }
    /// Steady clock; of the newest valid packet, 0 before it.
    [[nodiscard]] std::int64_t arrival_ns() const { return arrival_ns_; }
    /// How long ago the last valid packet was heard, seconds; 0 before the first.
    [[nodiscard]] double silent_s() const;

  private:
    net::PollResult read_socket();
    void follow(std::int64_t now_ns);

    net::HostLink& link_;
    Clock& clock_;
    Warn warn_;
    bool extrapolates_;
    std::uint16_t view_;
    ArrivalClock arrivals_;
    HostMotion motion_;
    HostWatch watch_;
    DropLog drop_log_;
    std::optional<std::uint16_t> followed_entity_;
    std::int64_t arrival_ns_ = 0;
    std::int64_t last_heard_ns_ = 0;
    std::optional<std::int64_t> last_jump_told_ns_;
};

}  // namespace eyepoint::ig
