#include "tools/replay/stop_signal.hpp"

#include <csignal>
#include <cstdint>

#include <sys/signalfd.h>

#include <unistd.h>

#include "net/nanoseconds.hpp"

namespace eyepoint::tools {
namespace {

// How long a signal may wait in a long sleep.
constexpr std::int64_t kSlice_ns = 100'000'000;

sigset_t stop_signals() {
    sigset_t signals;
    sigemptyset(&signals);
    sigaddset(&signals, SIGINT);
    sigaddset(&signals, SIGTERM);
    return signals;
}

std::int64_t nanoseconds(const timespec& time) {
    return time.tv_sec * net::kNanosecondsPerSecond + time.tv_nsec;
}

}  // namespace

StopSignal::StopSignal() {
    const sigset_t signals = stop_signals();
    pthread_sigmask(SIG_BLOCK, &signals, nullptr);
    descriptor_ = ::signalfd(-1, &signals, SFD_NONBLOCK | SFD_CLOEXEC);
}

StopSignal::~StopSignal() {
    if (descriptor_ >= 0) ::close(descriptor_);
    const sigset_t signals = stop_signals();
    pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);
}

bool StopSignal::came() const {
    signalfd_siginfo info{};
    if (!came_) came_ = ::read(descriptor_, &info, sizeof(info)) == sizeof(info);
    return came_;
}

bool StopSignal::came_before(const timespec& deadline) const {
    while (!came()) {
        timespec now{};
        clock_gettime(CLOCK_MONOTONIC, &now);
        const std::int64_t wake_ns = nanoseconds(now) + kSlice_ns;
        const bool last = wake_ns >= nanoseconds(deadline);
        const timespec wake =
            last ? deadline
                 : timespec{wake_ns / net::kNanosecondsPerSecond, wake_ns % net::kNanosecondsPerSecond};
        while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &wake, nullptr) != 0) {
        }
        if (last) return came();
    }
    return true;
}

}  // namespace eyepoint::tools
