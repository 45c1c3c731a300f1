/// Another program: started, listened to, stopped.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <sys/types.h>

#include <tl/expected.hpp>

namespace eyepoint::tools {

/// How a program ended.
struct Ending {
    std::optional<int> exit_code;  ///< absent when a signal ended it
    std::string standard_output;
    std::string standard_error;
};

/// A child process whose output is kept. It is killed if it still runs when this goes. Thread use: one
/// thread.
class ChildProcess {
  public:
    /// arguments[0] is the program, a path or a name on PATH; `environment` is added to this process's own.
    /// On failure: one sentence.
    [[nodiscard]] static tl::expected<ChildProcess, std::string> start(
        std::vector<std::string> arguments,
        const std::vector<std::pair<std::string, std::string>>& environment = {});
    ChildProcess(ChildProcess&& other) noexcept;
    ChildProcess& operator=(ChildProcess&& other) noexcept;
    ~ChildProcess();

    /// Waits until standard error holds the text; false when the program ends or the time passes first.
    [[nodiscard]] bool wait_for_error_text(const std::string& text, std::chrono::seconds patience);
    void send_signal(int signal) const;
    [[nodiscard]] pid_t id() const { return child_; }
    /// Waits for the end; past `patience` it is killed.
    [[nodiscard]] Ending wait(std::chrono::seconds patience);

  private:
    ChildProcess(pid_t child, int output, int error) : child_(child), output_(output), error_(error) {}
    /// Reads what has come, at most `patience` long; false once both streams are closed.
    bool read_some(std::chrono::milliseconds patience);

    pid_t child_ = -1;
    int output_ = -1;
    int error_ = -1;
    Ending ending_;
};

}  // namespace eyepoint::tools
