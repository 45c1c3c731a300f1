/// The trace of a whole run.
#include <csignal>

#include "tests/integration/run.hpp"
#include "tests/support/trace_file.hpp"

namespace eyepoint::testing {
namespace {

class TracedRun : public Run {
  protected:
    [[nodiscard]] std::filesystem::path trace() const { return scratch_.path() / "trace.json"; }
};

TEST_F(TracedRun, EveryFrameHasItsStagesNestedAndTimesRise) {
    start({"--trace", trace().string(), "--frames", "30"});
    send_flight(60);
    (void)end_with(std::nullopt);

    const auto tracks = tracks_of(text_of(trace()));
    const auto& spans = tracks.at("frame thread");
    EXPECT_TRUE(nest_and_rise(spans));
    const auto frames = named(spans, "frame");
    ASSERT_EQ(frames.size(), 30U);
    for (std::size_t i = 0; i < frames.size(); ++i) {
        EXPECT_EQ(frames[i].numbers.at("frame"), i + 1);
        for (const char* stage : {"host", "motion", "taking over blocks", "selection", "uploads",
                                  "draw calls", "wait for the GPU", "output", "record"})
            EXPECT_EQ(count_within(frames[i], spans, stage), 1U) << stage << " of frame " << i + 1;
        EXPECT_EQ(count_within(frames[i], tracks.at("GPU"), "picture"), 1U) << "frame " << i + 1;
    }
}

TEST_F(TracedRun, LoadsAreOnTheirThreadsTracks) {
    start({"--trace", trace().string(), "--frames", "5", "--set", "terrain.loader_threads=2"});
    send_flight(30);
    (void)end_with(std::nullopt);

    const auto tracks = tracks_of(text_of(trace()));
    std::size_t loads = 0;
    for (const char* name : {"loader 1", "loader 2"}) {
        const auto& spans = tracks.at(name);
        EXPECT_TRUE(nest_and_rise(spans)) << name;
        const auto read = named(spans, "read"), unfolded = named(spans, "unfold");
        ASSERT_EQ(read.size(), unfolded.size()) << name;
        for (std::size_t i = 0; i < read.size(); ++i) {
            EXPECT_EQ(read[i].end_ns, unfolded[i].begin_ns);
            EXPECT_EQ(read[i].numbers, unfolded[i].numbers);
            EXPECT_TRUE(read[i].numbers.contains("depth"));
        }
        loads += spans.size();
    }
    EXPECT_GE(loads, 4U);
}

TEST_F(TracedRun, AKilledRunLeavesATraceThatLacksNothingButItsEnd) {
    start({"--trace", trace().string()});
    send_flight(60);
    program_->send_signal(SIGKILL);
    (void)program_->wait(kPatience);
    EXPECT_FALSE(named(tracks_of(text_of(trace()) + "]").at("frame thread"), "frame").empty());
}

}  // namespace
}  // namespace eyepoint::testing
