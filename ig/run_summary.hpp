/// What a whole run came to, for the line at its end.
#pragma once

#include <cstdint>
#include <string>

#include "ig/distribution.hpp"
#include "ig/frame_record.hpp"
#include "net/host_session.hpp"

namespace eyepoint::ig {

/// Gathers a run's frames; its memory does not grow with them. Thread use: one thread.
class RunSummary {
  public:
    void add(const FrameEntry& entry);

    /// Percentiles within Distribution::kRelativeError. The delay counts each packet once, at the first frame
    /// that draws it.
    [[nodiscard]] std::string line(double seconds, const net::SessionCounters& host,
                                   std::uint64_t peak_resident_bytes) const;

    [[nodiscard]] std::uint64_t frames() const { return frame_ms_.count(); }

  private:
    Distribution frame_ms_;
    Distribution delay_ms_;
    Distribution triangles_;
    std::uint64_t missed_deadlines_ = 0;
};

/// "3 dropped: 2 short, 1 not finite", or "" where nothing was.
[[nodiscard]] std::string describe_drops(const net::SessionCounters& counters);

}  // namespace eyepoint::ig
