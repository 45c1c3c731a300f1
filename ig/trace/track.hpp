/// Telling a trace what happens: spans of time, each on the track of its thread.
#pragma once

#include <chrono>
#include <cstdint>

#include "ig/trace/span_ring.hpp"

namespace eyepoint::ig {

/// Nanoseconds of std::chrono::steady_clock.
[[nodiscard]] inline std::int64_t steady_now_ns() {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(
               std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

/// One row of a trace, as a value to pass on: a reference to it, or, made by default, one that takes nothing
/// and costs a comparison. The Trace outlives it. Thread use: spans of one track from one thread, and nested.
class Track {
  public:
    Track() = default;
    explicit Track(SpanRing& ring) : ring_(&ring) {}

    [[nodiscard]] bool on() const { return ring_ != nullptr; }
    void add(const SpanRecord& span) const {
        if (ring_ != nullptr) ring_->push(span);
    }

  private:
    SpanRing* ring_ = nullptr;
};

/// The time from its construction to its end.
class Span {
  public:
    Span(Track track, const char* name, SpanNumber number = {}) : track_(track) {
        if (track_.on()) record_ = {name, steady_now_ns(), 0, {{number}}};
    }
    ~Span() {
        if (!track_.on()) return;
        record_.end_ns = steady_now_ns();
        track_.add(record_);
    }
    Span(const Span&) = delete;
    Span& operator=(const Span&) = delete;

    /// What it turned out to be.
    void call(const char* name, SpanNumber number) {
        record_.name = name;
        record_.numbers[0] = number;
    }

  private:
    Track track_;
    SpanRecord record_;
};

}  // namespace eyepoint::ig
