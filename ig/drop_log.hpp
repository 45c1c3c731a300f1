/// One log line for many bad packets.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "net/host_session.hpp"

namespace eyepoint::ig {

/// Says what was dropped, at most once a second. Thread use: one thread.
class DropLog {
  public:
    static constexpr std::int64_t kQuietNs = 1'000'000'000;

    /// The line due now, if any: drops by reason since the last line, and what the newest was. `newest` is
    /// what a poll said of a drop, "" when it met none.
    [[nodiscard]] std::optional<std::string> line(const net::SessionCounters& counters,
                                                  const std::string& newest, std::int64_t now_ns);

  private:
    net::SessionCounters told_;
    std::string newest_;
    std::optional<std::int64_t> last_line_ns_;
};

}  // namespace eyepoint::ig
