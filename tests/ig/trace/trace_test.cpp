#include "ig/trace/trace.hpp"

#include <thread>

#include <gtest/gtest.h>

#include "tests/support/analytic_terrain.hpp"
#include "tests/support/trace_file.hpp"
#include "tools/bench/allocation_count.hpp"

namespace eyepoint::ig {
namespace {

using testing::text_of;
using testing::TracedSpan;
using testing::tracks_of;

class TraceFile : public ::testing::Test {
  protected:
    testing::ScratchFolder scratch_;
    std::filesystem::path file_ = scratch_.path() / "trace.json";
};

void trace_two_nested(Track track) {
    const Span outer(track, "outer", {"frame", 7});
    const Span inner(track, "inner");
}

TEST(Track, OffTakesNothingAndAllocatesNothing) {
    const std::uint64_t before = tools::heap_allocations();
    trace_two_nested(Track{});
    EXPECT_EQ(tools::heap_allocations(), before);
}

TEST_F(TraceFile, OnAllocatesNothingOnTheTracedThread) {
    const auto trace = Trace::create(file_).value();
    const Track track = trace->track("frame thread");
    const std::uint64_t before = tools::heap_allocations();
    for (int i = 0; i < 1000; ++i) trace_two_nested(track);
    EXPECT_EQ(tools::heap_allocations(), before);
}

TEST_F(TraceFile, HoldsEverySpanOfEveryThreadNestedAndRising) {
    const auto trace = Trace::create(file_).value();
    {
        std::vector<std::jthread> threads;
        for (const char* name : {"one", "two"})
            threads.emplace_back([track = trace->track(name)] {
                for (int i = 0; i < 500; ++i) trace_two_nested(track);
            });
    }
    ASSERT_TRUE(trace->finish().has_value());

    const auto tracks = tracks_of(text_of(file_));
    ASSERT_EQ(tracks.size(), 2U);
    for (const auto& [name, spans] : tracks) {
        EXPECT_EQ(spans.size(), 1000U) << name;
        EXPECT_TRUE(testing::nest_and_rise(spans)) << name;
        for (const TracedSpan& span : testing::named(spans, "outer"))
            EXPECT_EQ(span.numbers, (nlohmann::json{{"frame", 7}}));
    }
}

TEST_F(TraceFile, ASpanMayBeCalledSomethingElseAtItsEnd) {
    const auto trace = Trace::create(file_).value();
    {
        Span span(trace->track("frame thread"), "turn");
        span.call("frame", {"frame", 3});
    }
    ASSERT_TRUE(trace->finish().has_value());
    const auto spans = tracks_of(text_of(file_)).at("frame thread");
    ASSERT_EQ(spans.size(), 1U);
    EXPECT_EQ(spans[0].name, "frame");
    EXPECT_EQ(spans[0].numbers.at("frame"), 3);
}

TEST_F(TraceFile, WhatComesFasterThanItIsWrittenIsLeftOutAndCounted) {
    constexpr std::uint64_t kSpans = 50 * SpanRing::kCapacity;
    const auto trace = Trace::create(file_).value();
    const Track track = trace->track("flood");
    for (std::uint64_t i = 0; i < kSpans; ++i) track.add({"drop", steady_now_ns(), steady_now_ns(), {}});
    ASSERT_TRUE(trace->finish().has_value());
    const auto spans = tracks_of(text_of(file_)).at("flood");
    ASSERT_EQ(spans.back().name, "spans left out");
    EXPECT_EQ(spans.size() - 1 + spans.back().numbers.at("count").get<std::uint64_t>(), kSpans);
}

/// The array form lets its end be missing.
TEST_F(TraceFile, BeforeItsEndItLacksNothingButTheArraysEnd) {
    const auto trace = Trace::create(file_).value();
    trace_two_nested(trace->track("frame thread"));
    for (int patience = 0; patience < 200 && text_of(file_).find("outer") == std::string::npos; ++patience)
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    EXPECT_EQ(tracks_of(text_of(file_) + "]").at("frame thread").size(), 2U);
}

TEST_F(TraceFile, WithoutATrackIsAnEmptyTrace) {
    ASSERT_TRUE(Trace::create(file_).value()->finish().has_value());
    EXPECT_TRUE(tracks_of(text_of(file_)).empty());
}

TEST_F(TraceFile, APlaceThatCannotBeWrittenIsRefusedWithTheRemedy) {
    const auto trace = Trace::create(scratch_.path() / "nowhere" / "trace.json");
    ASSERT_FALSE(trace.has_value());
    EXPECT_NE(trace.error().find("--trace"), std::string::npos) << trace.error();
}

TEST(Trace, AFullDiskIsToldAtTheEnd) {
    if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "this system has no /dev/full";
    const auto trace = Trace::create("/dev/full").value();
    trace_two_nested(trace->track("frame thread"));
    const auto finished = trace->finish();
    ASSERT_FALSE(finished.has_value());
    EXPECT_NE(finished.error().find("free some space"), std::string::npos) << finished.error();
}

}  // namespace
}  // namespace eyepoint::ig
