/// The signals that end the program.
#pragma once

#include <csignal>

namespace eyepoint::ig {

/// While it lives: SIGINT and SIGTERM ask for a clean end, a second one of either ends the process at once
/// (exit status 128 + signal), and SIGPIPE is ignored, so that a dead child shows as a failed write. One at a
/// time in a process; its end puts back what was there before.
class StopSignals {
  public:
    StopSignals();
    ~StopSignals();
    StopSignals(const StopSignals&) = delete;
    StopSignals& operator=(const StopSignals&) = delete;

    /// Whether an end has been asked for. Thread use: any.
    [[nodiscard]] static bool requested();

  private:
    struct sigaction interrupt_before_ {};
    struct sigaction terminate_before_ {};
    struct sigaction pipe_before_ {};
};

}  // namespace eyepoint::ig
