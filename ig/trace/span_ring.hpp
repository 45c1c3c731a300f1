/// Spans on their way from the thread that they happen on to the thread that writes them.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <vector>

namespace eyepoint::ig {

/// A number told with a span. `name` has static storage and nothing that JSON escapes; nullptr: none.
struct SpanNumber {
    const char* name = nullptr;
    std::uint64_t value = 0;
};
using SpanNumbers = std::array<SpanNumber, 3>;

struct SpanRecord {
    const char* name = nullptr;  ///< static storage, nothing that JSON escapes
    std::int64_t begin_ns = 0;   ///< steady clock
    std::int64_t end_ns = 0;
    SpanNumbers numbers;
};

/// A ring of fixed size without locks. A span that finds it full is left out and counted. Thread use: push()
/// on one thread, take() on one other; lost() on any.
class SpanRing {
  public:
    static constexpr std::size_t kCapacity = 4096;

    /// Never waits, never allocates.
    void push(const SpanRecord& record) noexcept {
        const std::uint64_t place = pushed_.load(std::memory_order_relaxed);
        if (place - taken_.load(std::memory_order_acquire) == kCapacity) {
            lost_.fetch_add(1, std::memory_order_relaxed);
            return;
        }
        records_[place % kCapacity] = record;
        pushed_.store(place + 1, std::memory_order_release);
    }

    /// Hands every span that is there to `each`, oldest first.
    template <typename Each>
    void take(const Each& each) {
        const std::uint64_t until = pushed_.load(std::memory_order_acquire);
        std::uint64_t place = taken_.load(std::memory_order_relaxed);
        for (; place != until; ++place) {
            each(records_[place % kCapacity]);
            taken_.store(place + 1, std::memory_order_release);
        }
    }

    [[nodiscard]] std::uint64_t lost() const { return lost_.load(std::memory_order_relaxed); }

  private:
    std::vector<SpanRecord> records_ = std::vector<SpanRecord>(kCapacity);
    std::atomic<std::uint64_t> pushed_ = 0, taken_ = 0, lost_ = 0;
};

}  // namespace eyepoint::ig
