/// A progress bar on a terminal; nothing where stderr is none.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace eyepoint::tools {

/// One line on stderr, redrawn in place at most ten times a second, cleared when the bar goes.
/// Thread use: one thread.
class ProgressBar {
  public:
    explicit ProgressBar(std::string label);
    ~ProgressBar();
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;

    void show(std::uint64_t done, std::uint64_t total);

  private:
    std::string label_;
    bool on_terminal_;
    bool drawn_ = false;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    std::chrono::steady_clock::time_point next_ = start_;
};

}  // namespace eyepoint::tools
