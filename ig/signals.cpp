#include "ig/signals.hpp"

#include <atomic>

#include <unistd.h>

namespace eyepoint::ig {

namespace {

// A signal handler can reach nothing but static storage.
std::atomic<bool> stop_requested{false};
static_assert(std::atomic<bool>::is_always_lock_free);

extern "C" void request_stop(int signal) {
    if (stop_requested.exchange(true)) _exit(128 + signal);
}

struct sigaction with_handler(void (*handler)(int)) {
    struct sigaction action {};
    action.sa_handler = handler;
    sigemptyset(&action.sa_mask);
    return action;
}

}  // namespace

StopSignals::StopSignals() {
    stop_requested = false;
    const struct sigaction stop = with_handler(request_stop);
    const struct sigaction ignore = with_handler(SIG_IGN);
    sigaction(SIGINT, &stop, &interrupt_before_);
    sigaction(SIGTERM, &stop, &terminate_before_);
    sigaction(SIGPIPE, &ignore, &pipe_before_);
}

StopSignals::~StopSignals() {
    sigaction(SIGINT, &interrupt_before_, nullptr);
    sigaction(SIGTERM, &terminate_before_, nullptr);
    sigaction(SIGPIPE, &pipe_before_, nullptr);
}

bool StopSignals::requested() { return stop_requested; }

}  // namespace eyepoint::ig
