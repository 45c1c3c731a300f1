/// What is worth saying of how often a host speaks.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace eyepoint::ig {

/// One sentence when the host falls silent, when it speaks again, and when its rate becomes slow, fast or
/// ordinary: the rate over kWindowNs, told when it changes its kind. Pure; thread use: one thread.
class HostWatch {
  public:
    static constexpr std::int64_t kSilenceNs = 2'000'000'000;
    static constexpr std::int64_t kWindowNs = 4'000'000'000;
    static constexpr double kSlowHz = 10.0;
    static constexpr double kFastFrames = 4.0;  ///< packets a frame

    /// rate_hz: frames a second.
    explicit HostWatch(double rate_hz) : rate_hz_(rate_hz) {}

    /// Once a turn of the frame loop. `applied`: the valid packets heard in it.
    [[nodiscard]] std::optional<std::string> hear(unsigned applied, std::int64_t now_ns);

  private:
    enum class Kind : std::uint8_t { Ordinary, Slow, Fast };
    [[nodiscard]] std::optional<std::string> told_rate(std::int64_t now_ns);

    double rate_hz_;
    std::optional<std::int64_t> last_heard_ns_;
    bool silent_ = false;
    std::int64_t window_ns_ = 0;
    std::uint64_t in_window_ = 0;
    Kind kind_ = Kind::Ordinary;
};

}  // namespace eyepoint::ig
