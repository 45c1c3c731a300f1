/// A trace of a run for the Perfetto UI, in Chrome's JSON trace event format (array form).
#pragma once

#include <condition_variable>
#include <deque>
#include <filesystem>
#include <fstream>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include <tl/expected.hpp>

#include "ig/trace/track.hpp"

namespace eyepoint::ig {

/// Owns the tracks and the file; a thread of its own writes, every 50 ms, so that those which are traced
/// neither wait nor format. Memory: one SpanRing (some 300 KB) a track, whatever the run's length. A span
/// that comes while its ring is full is left out; the file then ends with how many were.
///
/// The file can be loaded at any time, also after a crash: the array form may lack its end, and events are
/// written in whole batches. Thread use: one thread; tracks are used on theirs.
class Trace {
  public:
    /// Replaces a file of that name. On failure: one sentence with the remedy.
    [[nodiscard]] static tl::expected<std::unique_ptr<Trace>, std::string> create(
        const std::filesystem::path& file);
    ~Trace();
    Trace(const Trace&) = delete;
    Trace& operator=(const Trace&) = delete;

    /// A new row, in this order from the top. The name holds nothing that JSON escapes.
    [[nodiscard]] Track track(const std::string& name);

    /// Writes what is left and the array's end; later spans are not written. On failure (disk full): one
    /// sentence. The destructor does the same, and says nothing.
    [[nodiscard]] tl::expected<void, std::string> finish();

  private:
    Trace(std::filesystem::path file, std::ofstream stream);
    void write_now_and_then(const std::stop_token& stop);
    void write_spans();

    struct Row {
        int number;
        SpanRing ring;
    };

    std::filesystem::path file_;
    std::ofstream stream_;
    std::int64_t begin_ns_;
    std::mutex mutex_;  ///< of rows_ as a list, stream_ and batch_
    std::deque<Row> rows_;
    std::string batch_;
    int write_fault_ = 0;  ///< errno of the first write that failed
    std::condition_variable_any wake_;
    std::jthread writer_;  ///< last: it ends before what it uses is gone
};

}  // namespace eyepoint::ig
