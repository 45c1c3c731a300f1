/// Sends a recorded flight over UDP at the times it was recorded at.
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>

#include <tl/expected.hpp>

#include "tools/replay/stop_signal.hpp"

namespace eyepoint::tools {

struct PlayRequest {
    std::filesystem::path file;
    std::string to;       ///< "HOST:PORT"
    double rate = 1.0;    ///< 2: twice as fast
    double from_s = 0.0;  ///< after the first datagram to the port
    double until_s = std::numeric_limits<double>::infinity();
    std::optional<std::uint16_t> port;  ///< captured destination port; absent: see choose_port
    bool loop = false;                  ///< from the beginning again, until stopped
};

struct PlayReport {
    std::uint64_t packets = 0;
    std::uint64_t send_errors = 0;
    double seconds = 0.0;    ///< from the first datagram to the last
    double latest_ms = 0.0;  ///< how late the latest datagram went out
    bool stopped = false;    ///< by a signal
};

/// Deadlines are absolute on the monotonic clock, so lateness does not add up. On failure: one sentence.
[[nodiscard]] tl::expected<PlayReport, std::string> play(const PlayRequest& request, const StopSignal& stop);

}  // namespace eyepoint::tools
