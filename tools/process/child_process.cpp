#include "tools/process/child_process.hpp"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <utility>

#include <sys/wait.h>

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <unistd.h>

extern char** environ;

namespace eyepoint::tools {

namespace {

using Clock = std::chrono::steady_clock;

std::vector<std::string> joined_environment(const std::vector<std::pair<std::string, std::string>>& added) {
    std::vector<std::string> all;
    for (char** variable = environ; *variable != nullptr; ++variable) {
        const std::string text = *variable;
        bool replaced = false;
        for (const auto& [name, value] : added) replaced = replaced || text.rfind(name + "=", 0) == 0;
        if (!replaced) all.push_back(text);
    }
    for (const auto& [name, value] : added) all.push_back(name + "=" + value);
    return all;
}

std::vector<char*> pointers_to(std::vector<std::string>& texts) {
    std::vector<char*> pointers;
    for (std::string& text : texts) pointers.push_back(text.data());
    pointers.push_back(nullptr);
    return pointers;
}

/// Appends what waits in the descriptor; closes it and sets it to -1 at its end.
void drain(int& descriptor, std::string& into) {
    std::array<char, 4096> buffer{};
    const ssize_t got = read(descriptor, buffer.data(), buffer.size());
    if (got > 0) {
        into.append(buffer.data(), static_cast<std::size_t>(got));
    } else if (got == 0 || errno != EINTR) {
        close(descriptor);
        descriptor = -1;
    }
}

}  // namespace

tl::expected<ChildProcess, std::string> ChildProcess::start(
    std::vector<std::string> arguments, const std::vector<std::pair<std::string, std::string>>& environment) {
    std::array<int, 2> output{}, error{};
    if (pipe2(output.data(), O_CLOEXEC) != 0)
        return tl::unexpected(arguments[0] + ": no pipe can be made; too many files are open");
    if (pipe2(error.data(), O_CLOEXEC) != 0) {
        for (const int end : output) close(end);
        return tl::unexpected(arguments[0] + ": no pipe can be made; too many files are open");
    }
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, output[1], STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, error[1], STDERR_FILENO);
    auto variables = joined_environment(environment);
    pid_t child = -1;
    const int fault = posix_spawnp(&child, arguments[0].c_str(), &actions, nullptr,
                                   pointers_to(arguments).data(), pointers_to(variables).data());
    posix_spawn_file_actions_destroy(&actions);
    close(output[1]);
    close(error[1]);
    ChildProcess process(fault == 0 ? child : -1, output[0], error[0]);
    if (fault != 0) return tl::unexpected(arguments[0] + " cannot be started: " + std::strerror(fault));
    return process;
}

ChildProcess::ChildProcess(ChildProcess&& other) noexcept
    : child_(std::exchange(other.child_, -1)),
      output_(std::exchange(other.output_, -1)),
      error_(std::exchange(other.error_, -1)),
      ending_(std::move(other.ending_)) {}

ChildProcess& ChildProcess::operator=(ChildProcess&& other) noexcept {
    std::swap(child_, other.child_);
    std::swap(output_, other.output_);
    std::swap(error_, other.error_);
    std::swap(ending_, other.ending_);
    return *this;
}

ChildProcess::~ChildProcess() {
    if (child_ > 0) {
        kill(child_, SIGKILL);
        waitpid(child_, nullptr, 0);
    }
    if (output_ >= 0) close(output_);
    if (error_ >= 0) close(error_);
}

bool ChildProcess::read_some(std::chrono::milliseconds patience) {
    if (output_ < 0 && error_ < 0) return false;
    std::array<pollfd, 2> streams{pollfd{output_, POLLIN, 0}, pollfd{error_, POLLIN, 0}};
    if (poll(streams.data(), streams.size(), static_cast<int>(patience.count())) > 0) {
        if (streams[0].revents != 0) drain(output_, ending_.standard_output);
        if (streams[1].revents != 0) drain(error_, ending_.standard_error);
    }
    return true;
}

bool ChildProcess::wait_for_error_text(const std::string& text, std::chrono::seconds patience) {
    const auto until = Clock::now() + patience;
    while (ending_.standard_error.find(text) == std::string::npos) {
        if (Clock::now() > until || !read_some(std::chrono::milliseconds(50))) return false;
    }
    return true;
}

void ChildProcess::send_signal(int signal) const { kill(child_, signal); }

Ending ChildProcess::wait(std::chrono::seconds patience) {
    const auto until = Clock::now() + patience;
    while (read_some(std::chrono::milliseconds(50))) {
        if (Clock::now() > until) send_signal(SIGKILL);
    }
    int status = 0;
    waitpid(child_, &status, 0);
    child_ = -1;
    if (WIFEXITED(status)) ending_.exit_code = WEXITSTATUS(status);
    return ending_;
}

}  // namespace eyepoint::tools
