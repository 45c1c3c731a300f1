/// A flight of the bench with a trace and without.
#include <gtest/gtest.h>

#include "tests/picture/flights.hpp"
#include "tests/support/analytic_terrain.hpp"
#include "tests/support/trace_file.hpp"
#include "tools/bench/allocation_count.hpp"
#include "tools/bench/bench_run.hpp"

namespace eyepoint::tools {
namespace {

constexpr std::size_t kFrames = 6;

class TracedFlight : public ::testing::Test {
  protected:
    TracedFlight() {
        (void)testing::make_database({.detail_depth = 8}, scratch_.path() / "terrain");
        options_.terrain = scratch_.path() / "terrain";
        options_.size = {160, 90};
        options_.scene.lod_method = "nested";
        options_.scene.shading = ig::Shading::Deferred;
        options_.scene.loader_threads = 2;
        options_.hash_pictures = true;
        options_.allocations = heap_allocations;
        eyes_ = testing::eyes_of(testing::sample_flight(), options_.size, 1.0);
        eyes_.resize(kFrames);
    }

    [[nodiscard]] std::vector<BenchFrame> flown(const std::optional<std::filesystem::path>& trace) {
        options_.trace = trace;
        return run_bench(options_, eyes_).value().frames;
    }

    testing::ScratchFolder scratch_;
    BenchOptions options_;
    std::vector<ig::FlightEye> eyes_;
};

TEST_F(TracedFlight, TheTraceHasEveryFramesStagesAndTheLoads) {
    const auto file = scratch_.path() / "trace.json";
    (void)flown(file);
    const auto tracks = testing::tracks_of(testing::text_of(file));
    const auto& spans = tracks.at("frame thread");
    EXPECT_TRUE(testing::nest_and_rise(spans));
    const auto frames = testing::named(spans, "frame");
    ASSERT_EQ(frames.size(), kFrames);
    for (const testing::TracedSpan& frame : frames) {
        for (const char* stage : {"uploads", "draw calls", "wait for the GPU", "output"})
            EXPECT_EQ(testing::count_within(frame, spans, stage), 1U) << stage;
        EXPECT_EQ(testing::count_within(frame, tracks.at("GPU"), "picture"), 1U);
    }
    std::size_t loads = 0;
    for (const char* name : {"loader 1", "loader 2"}) {
        EXPECT_TRUE(testing::nest_and_rise(tracks.at(name))) << name;
        loads += testing::named(tracks.at(name), "read").size();
    }
    EXPECT_GT(loads, 20U);
}

TEST_F(TracedFlight, ATraceChangesNeitherPicturesNorCounts) {
    const auto plain = flown(std::nullopt), traced = flown(scratch_.path() / "trace.json");
    for (std::size_t i = 0; i < kFrames; ++i) {
        EXPECT_EQ(traced[i].picture_hash, plain[i].picture_hash) << i;
        EXPECT_EQ(traced[i].entry.drawn.triangles, plain[i].entry.drawn.triangles) << i;
        EXPECT_EQ(traced[i].gl_calls, plain[i].gl_calls) << i;
        EXPECT_EQ(traced[i].allocations, plain[i].allocations) << i;
    }
}

TEST_F(TracedFlight, APlaceThatCannotBeWrittenIsRefusedAtTheStart) {
    options_.trace = scratch_.path() / "nowhere" / "trace.json";
    const auto result = run_bench(options_, eyes_);
    ASSERT_FALSE(result.has_value());
    EXPECT_NE(result.error().find("--trace"), std::string::npos) << result.error();
}

}  // namespace
}  // namespace eyepoint::tools
