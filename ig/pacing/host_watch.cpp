#include "ig/pacing/host_watch.hpp"

#include <utility>

#include <fmt/format.h>

namespace eyepoint::ig {

namespace {

double seconds(std::int64_t ns) { return static_cast<double>(ns) * 1e-9; }

}  // namespace

std::optional<std::string> HostWatch::hear(unsigned applied, std::int64_t now_ns) {
    if (applied == 0) {
        if (!last_heard_ns_ || silent_ || now_ns - *last_heard_ns_ < kSilenceNs) return std::nullopt;
        silent_ = true;
        return fmt::format("no packet from the host for {:.1f} s; the last eye stays",
                           seconds(now_ns - *last_heard_ns_));
    }
    const std::int64_t before_ns = std::exchange(last_heard_ns_, now_ns).value_or(now_ns);
    if (std::exchange(silent_, false) || before_ns == now_ns) {
        const bool is_first = before_ns == now_ns;
        window_ns_ = now_ns;
        in_window_ = 0;
        if (is_first) return std::nullopt;
        return fmt::format("the host speaks again after {:.1f} s", seconds(now_ns - before_ns));
    }
    in_window_ += applied;
    return now_ns - window_ns_ < kWindowNs ? std::nullopt : told_rate(now_ns);
}

std::optional<std::string> HostWatch::told_rate(std::int64_t now_ns) {
    const double packets_hz = static_cast<double>(in_window_) / seconds(now_ns - window_ns_);
    window_ns_ = now_ns;
    in_window_ = 0;
    Kind kind = Kind::Ordinary;
    if (packets_hz < kSlowHz) kind = Kind::Slow;
    if (packets_hz > kFastFrames * rate_hz_) kind = Kind::Fast;
    if (std::exchange(kind_, kind) == kind) return std::nullopt;
    const std::string rate = fmt::format("the host sends {:.1f} packets a second", packets_hz);
    switch (kind) {
        case Kind::Slow:
            return rate + ": too few for smooth motion; let it send at least " + fmt::format("{:g}", kSlowHz);
        case Kind::Fast:
            return rate + fmt::format(" for {:g} frames: each draws the newest", rate_hz_);
        case Kind::Ordinary:
            break;
    }
    return rate;
}

}  // namespace eyepoint::ig
