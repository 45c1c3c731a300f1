#include "ig/drop_log.hpp"

#include <fmt/format.h>

#include "ig/run_summary.hpp"

namespace eyepoint::ig {

namespace {

net::SessionCounters drops_since(const net::SessionCounters& before, net::SessionCounters now) {
    for (std::size_t i = 0; i < now.dropped.size(); ++i) now.dropped[i] -= before.dropped[i];
    return now;
}

}  // namespace

std::optional<std::string> DropLog::line(const net::SessionCounters& counters, const std::string& newest,
                                         std::int64_t now_ns) {
    if (!newest.empty()) newest_ = newest;
    const net::SessionCounters fresh = drops_since(told_, counters);
    if (fresh.dropped_total() == 0) return std::nullopt;
    if (last_line_ns_ && now_ns - *last_line_ns_ < kQuietNs) return std::nullopt;
    told_ = counters;
    last_line_ns_ = now_ns;
    return fmt::format("bad packets, {}; newest: {}", describe_drops(fresh), newest_);
}

}  // namespace eyepoint::ig
