/// Ctrl-C and SIGTERM as something to ask for, instead of an end in the middle.
#pragma once

#include <ctime>

namespace eyepoint::tools {

/// While it lives, SIGINT and SIGTERM do not end the thread that made it: they are kept, to be asked for. One
/// at a time; make it before any other thread starts.
class StopSignal {
  public:
    StopSignal();
    ~StopSignal();
    StopSignal(const StopSignal&) = delete;
    StopSignal& operator=(const StopSignal&) = delete;

    /// True once a signal has come. Never blocks.
    [[nodiscard]] bool came() const;

    /// Sleeps until a time of CLOCK_MONOTONIC, without drift. True at once when a signal comes first.
    [[nodiscard]] bool came_before(const timespec& deadline) const;

  private:
    int descriptor_ = -1;
    mutable bool came_ = false;
};

}  // namespace eyepoint::tools
