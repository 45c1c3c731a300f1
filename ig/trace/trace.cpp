#include "ig/trace/trace.hpp"

#include <cerrno>
#include <chrono>
#include <cstring>
#include <iterator>
#include <utility>

#include <fmt/format.h>

namespace eyepoint::ig {

namespace {

constexpr std::chrono::milliseconds kWriteEvery{50};
constexpr int kProcess = 1;

/// The format counts microseconds; nanoseconds stay whole in the decimals, so spans nest exactly.
void append_us(std::string& batch, const char* key, std::int64_t ns) {
    fmt::format_to(std::back_inserter(batch), R"(,"{}":{}.{:03})", key, ns / 1000, ns % 1000);
}

void append_span(std::string& batch, const SpanRecord& span, int row, std::int64_t begin_ns) {
    fmt::format_to(std::back_inserter(batch), ",\n{{\"name\":\"{}\",\"ph\":\"X\",\"pid\":{},\"tid\":{}",
                   span.name, kProcess, row);
    append_us(batch, "ts", span.begin_ns - begin_ns);
    append_us(batch, "dur", span.end_ns - span.begin_ns);
    const char* before = R"(,"args":{)";
    for (const SpanNumber& number : span.numbers) {
        if (number.name == nullptr) break;
        fmt::format_to(std::back_inserter(batch), R"({}"{}":{})", before, number.name, number.value);
        before = ",";
    }
    batch += span.numbers[0].name == nullptr ? "}" : "}}";
}

}  // namespace

tl::expected<std::unique_ptr<Trace>, std::string> Trace::create(const std::filesystem::path& file) {
    std::ofstream stream(file, std::ios::trunc);
    if (stream) return std::unique_ptr<Trace>{new Trace(file, std::move(stream))};
    return tl::unexpected(fmt::format(
        "{}: the trace cannot be written there ({}); give --trace a file in a folder that you may "
        "write to",
        file.string(), std::strerror(errno)));
}

Trace::Trace(std::filesystem::path file, std::ofstream stream)
    : file_(std::move(file)),
      stream_(std::move(stream)),
      begin_ns_(steady_now_ns()),
      batch_(fmt::format("[\n{{\"name\":\"process_name\",\"ph\":\"M\",\"pid\":{},\"tid\":0,\"args\":{{"
                         "\"name\":\"eyepoint\"}}}}",
                         kProcess)),
      writer_([this](const std::stop_token& stop) { write_now_and_then(stop); }) {}

Trace::~Trace() { (void)finish(); }

Track Trace::track(const std::string& name) {
    const std::scoped_lock lock(mutex_);
    const int number = static_cast<int>(rows_.size()) + 1;
    Row& row = rows_.emplace_back();
    row.number = number;
    constexpr const char* kRow = ",\n{{\"name\":\"{}\",\"ph\":\"M\",\"pid\":{},\"tid\":{},\"args\":{{{}}}}}";
    batch_ +=
        fmt::format(fmt::runtime(kRow), "thread_name", kProcess, number, fmt::format(R"("name":"{}")", name));
    batch_ += fmt::format(fmt::runtime(kRow), "thread_sort_index", kProcess, number,
                          fmt::format(R"("sort_index":{})", number));
    return Track{row.ring};
}

void Trace::write_now_and_then(const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    while (!stop.stop_requested()) {
        write_spans();
        wake_.wait_for(lock, stop, kWriteEvery, [] { return false; });
    }
}

/// Needs the lock.
void Trace::write_spans() {
    for (Row& row : rows_)
        row.ring.take([&](const SpanRecord& span) { append_span(batch_, span, row.number, begin_ns_); });
    stream_ << batch_ << std::flush;
    batch_.clear();
    if (!stream_ && write_fault_ == 0) write_fault_ = errno;
}

tl::expected<void, std::string> Trace::finish() {
    if (writer_.joinable()) {
        writer_.request_stop();
        writer_.join();
        write_spans();
        for (const Row& row : rows_) {
            if (row.ring.lost() == 0) continue;
            const std::int64_t now_ns = steady_now_ns();
            append_span(batch_, {"spans left out", now_ns, now_ns, {{{"count", row.ring.lost()}}}},
                        row.number, begin_ns_);
        }
        batch_ += "\n]\n";
        write_spans();
    }
    if (write_fault_ == 0) return {};
    return tl::unexpected(fmt::format("{}: the trace could not be written on ({}); free some space",
                                      file_.string(), std::strerror(write_fault_)));
}

}  // namespace eyepoint::ig
