#include "ig/run_summary.hpp"

#include <gtest/gtest.h>

#include "ig/drop_log.hpp"

namespace eyepoint::ig {
namespace {

net::SessionCounters counters_with(std::uint64_t short_ones, std::uint64_t not_finite) {
    net::SessionCounters counters;
    counters.datagrams = 100;
    counters.dropped[static_cast<std::size_t>(net::DropReason::Short)] = short_ones;
    counters.dropped[static_cast<std::size_t>(net::DropReason::NotFinite)] = not_finite;
    return counters;
}

bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(RunSummary, SaysFramesRatePercentilesAndMisses) {
    RunSummary summary;
    for (int i = 1; i <= 100; ++i) {
        FrameEntry entry;
        entry.frame_ms = i;
        entry.arrival_to_complete_ms = 1000.0;
        entry.new_packet = false;
        entry.missed_deadlines = i == 50 ? 3 : 0;
        entry.drawn.triangles = 40'000;
        summary.add(entry);
    }
    const std::string line = summary.line(10.0, {}, 300ULL << 20);
    EXPECT_TRUE(holds(line, "100 frames in 10.0 s (10.0 Hz)")) << line;
    EXPECT_TRUE(holds(line, "max 100.00")) << line;
    EXPECT_TRUE(holds(line, "3 missed deadlines")) << line;
    EXPECT_TRUE(holds(line, "peak memory 300 MiB")) << line;
    EXPECT_TRUE(holds(line, "delay ms p50 0.00"))
        << "repeated pictures of an old packet count as delay: " << line;
    EXPECT_FALSE(holds(line, "dropped")) << line;
    EXPECT_FALSE(holds(line, "\n")) << line;
}

TEST(RunSummary, SaysTheDelayOfEachPacketOnce) {
    RunSummary summary;
    for (int i = 1; i <= 1000; ++i) {
        FrameEntry entry;
        entry.arrival_to_complete_ms = i % 10 == 0 ? 500.0 : 0.02 * i;
        entry.new_packet = i % 10 != 0;
        summary.add(entry);
    }
    // Distribution::kRelativeError on 10.0, 19.0, 19.8; the largest is exact.
    const std::string line = summary.line(10.0, {}, 0);
    EXPECT_TRUE(holds(line, "delay ms p50 10.") || holds(line, "delay ms p50 9.9")) << line;
    EXPECT_TRUE(holds(line, " p95 18.9") || holds(line, " p95 19.0")) << line;
    EXPECT_TRUE(holds(line, " p99 19.7") || holds(line, " p99 19.8")) << line;
    EXPECT_TRUE(holds(line, "max 19.98; ")) << line;
}

TEST(RunSummary, OfNoFramesIsStillALine) {
    const std::string line = RunSummary{}.line(0.0, {}, 0);
    EXPECT_TRUE(holds(line, "0 frames in 0.0 s (0.0 Hz)")) << line;
}

TEST(RunSummary, NamesDropsByReason) {
    const std::string line = RunSummary{}.line(1.0, counters_with(2, 1), 0);
    EXPECT_TRUE(holds(line, "3 dropped: 2 short, 1 not finite")) << line;
}

constexpr std::int64_t kSecondNs = 1'000'000'000;

TEST(DropLog, IsSilentWhileNothingIsDropped) {
    DropLog log;
    EXPECT_FALSE(log.line({}, "", 0).has_value());
}

TEST(DropLog, FirstDropIsToldAtOnceWithItsDetail) {
    DropLog log;
    const auto line = log.line(counters_with(1, 0), "12 bytes from 127.0.0.1:9", 5);
    ASSERT_TRUE(line.has_value());
    EXPECT_TRUE(holds(*line, "1 dropped: 1 short")) << *line;
    EXPECT_TRUE(holds(*line, "12 bytes from 127.0.0.1:9")) << *line;
}

TEST(DropLog, AFloodGivesOneLineASecondWithTheCountsSinceTheLast) {
    DropLog log;
    int lines = 0;
    std::string last;
    for (std::uint64_t i = 1; i <= 301; ++i) {
        const auto now_ns = static_cast<std::int64_t>(i) * kSecondNs / 100;
        if (const auto line = log.line(counters_with(i, 0), "newest " + std::to_string(i), now_ns)) {
            ++lines;
            last = *line;
        }
    }
    EXPECT_EQ(lines, 4);  // at 0.01, 1.01, 2.01 and 3.01 s
    EXPECT_TRUE(holds(last, "100 dropped: 100 short")) << last;
    EXPECT_TRUE(holds(last, "newest 301")) << last;
}

TEST(DropLog, DropsInTheQuietTimeAreToldAfterIt) {
    DropLog log;
    ASSERT_TRUE(log.line(counters_with(1, 0), "a", 0).has_value());
    ASSERT_FALSE(log.line(counters_with(1, 1), "b", kSecondNs / 2).has_value());
    const auto line = log.line(counters_with(1, 1), "", kSecondNs);
    ASSERT_TRUE(line.has_value());
    EXPECT_TRUE(holds(*line, "1 dropped: 1 not finite")) << *line;
    EXPECT_TRUE(holds(*line, "newest: b")) << *line;
}

}  // namespace
}  // namespace eyepoint::ig
