/// Goals of the published methods, and of the default beside them, from figures made up for the purpose.
#include <array>
#include <stdexcept>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tools/bench/goals/bintree_goals.hpp"
#include "tools/bench/goals/default_goals.hpp"
#include "tools/bench/goals/hyperblock_goals.hpp"
#include "tools/bench/goals/selective_goals.hpp"

namespace eyepoint::tools {
namespace {

using ::testing::HasSubstr;

const GoalLine& line_about(const std::vector<GoalLine>& lines, const std::string& what,
                           const std::string& test) {
    for (const GoalLine& line : lines)
        if (line.what.find(what) != std::string::npos && line.what.find(test) != std::string::npos)
            return line;
    throw std::out_of_range("no line about " + what + ", " + test);
}

FlightFigures selected(double triangles, double selection_us, terrain::SelectionAudit audit) {
    FlightFigures figures;
    figures.triangles_mean = triangles;
    figures.selection_us_mean = selection_us;
    figures.audit = audit;
    return figures;
}

TEST(SelectiveGoals, AreTheCachesAgainstNone) {
    const auto lines =
        selective_goals({.uncached = selected(1000.0, 500.0, {}),
                         .four_corner = selected(950.0, 25.0, {.selected = 1000, .missed = 17, .too_far = 3}),
                         .sound = selected(960.0, 15.0, {.selected = 1000, .missed = 30, .too_far = 0})});
    EXPECT_DOUBLE_EQ(*line_about(lines, "CPU", "four corners").figure, 5.0);
    EXPECT_EQ(line_about(lines, "CPU", "four corners").verdict(), GoalVerdict::Missed);
    EXPECT_EQ(line_about(lines, "CPU", "sound test").verdict(), GoalVerdict::Met);
    EXPECT_NEAR(*line_about(lines, "triangles", "four corners").figure, -5.0, 1e-9);
    EXPECT_EQ(line_about(lines, "triangles", "four corners").verdict(), GoalVerdict::Missed);
    EXPECT_EQ(line_about(lines, "triangles", "sound test").verdict(), GoalVerdict::Met);
    EXPECT_NEAR(*line_about(lines, "missed", "four corners").figure, 1.7, 1e-9);
    EXPECT_EQ(line_about(lines, "beyond", "sound test").verdict(), GoalVerdict::Met);
}

TEST(SelectiveGoals, OneVertexBeyondWithTheSoundTestIsMissed) {
    const FlightFigures any = selected(1000.0, 500.0, {.selected = 1000});
    const auto lines = selective_goals({any, any, selected(1000.0, 1.0, {.selected = 1000, .too_far = 1})});
    EXPECT_EQ(line_about(lines, "beyond", "sound test").verdict(), GoalVerdict::Missed);
}

TEST(SelectiveGoals, GenerationIsInInstructionsAndMayBeUnknown) {
    const auto lines = generation_goals(
        GenerationInstructions{.uncached = 1e6, .four_corner = 41e3, .sound = 39e3, .a_rebuilt_post = 40.0});
    EXPECT_EQ(line_about(lines, "of uncached", "four corners").verdict(), GoalVerdict::Missed);
    EXPECT_EQ(line_about(lines, "of uncached", "sound test").verdict(), GoalVerdict::Met);
    EXPECT_EQ(line_about(lines, "a block post", "").verdict(), GoalVerdict::Met);
    for (const GoalLine& line : generation_goals({})) EXPECT_EQ(line.verdict(), GoalVerdict::NotMeasured);
}

// One block of 513 triangles is a tree of 1024 nodes; two sets of 256 bytes are half a byte for each.
TEST(BintreeGoals, ANodesBytesAreItsBlocks) {
    FlightFigures flown;
    flown.blocks_drawn_mean = 1.0;
    flown.triangles_mean = 513.0;
    const auto lines = node_goals(flown);
    ASSERT_EQ(lines.size(), 2U);
    EXPECT_DOUBLE_EQ(*lines[0].figure, 0.5);
    EXPECT_DOUBLE_EQ(*lines[1].figure, 0.5 + 33.0 * 33.0 * 4.0 / 1024.0);
}

TEST(BintreeGoals, MemoryIsAboveABareProcessAndWaitingIsCounted) {
    FlightResult drawn;
    drawn.frames = 4;
    drawn.columns["loads_pending"] = {0.0, 3.0, 0.0, 1.0};
    drawn.figures = {{"bare_resident_bytes", 100.0 * 1048576.0}, {"peak_resident_bytes", 300.0 * 1048576.0}};
    const auto lines = streaming_goals(drawn);
    ASSERT_EQ(lines.size(), 2U);
    EXPECT_DOUBLE_EQ(*lines[0].figure, 200.0);
    EXPECT_EQ(lines[0].verdict(), GoalVerdict::Met);
    EXPECT_DOUBLE_EQ(*lines[1].figure, 2.0);
    EXPECT_EQ(lines[1].verdict(), GoalVerdict::Missed);
}

TEST(HyperblockGoals, AreTheTwinAndFlatness) {
    const std::array by_vertex{TurnFrame{.cpu_ms = 100.0}}, by_block{TurnFrame{.cpu_ms = 76.0}};
    EXPECT_EQ(twin_goal({by_vertex, by_block}).verdict(), GoalVerdict::Missed);
    EXPECT_EQ(twin_goal({by_vertex, std::array{TurnFrame{.cpu_ms = 74.0}}}).verdict(), GoalVerdict::Met);
    FlightFigures cheap, dear;
    cheap.selection_us_median = 100.0;
    dear.selection_us_median = 131.0;
    const std::array flights{SelectionAtTau{0.25, dear}, SelectionAtTau{4.0, cheap}};
    EXPECT_DOUBLE_EQ(*flat_selection_goal(flights).figure, 1.31);
    EXPECT_EQ(flat_selection_goal(flights).verdict(), GoalVerdict::Missed);
}

// One method has the fewest triangles, another the cheapest frames: each line is against the harder one.
TEST(DefaultGoals, AreAgainstTheBestOfThePublishedMethods) {
    const MatchedMethod it{"nested", 1.5, 900.0, {TurnFrame{.cpu_ms = 45.0}}};
    const std::array published{MatchedMethod{"few", 1.0, 1000.0, {TurnFrame{.cpu_ms = 60.0}}},
                               MatchedMethod{"fast", 1.0, 3000.0, {TurnFrame{.cpu_ms = 40.0}}}};
    const auto lines = default_goals(it, published);
    ASSERT_EQ(lines.size(), 2U);
    EXPECT_DOUBLE_EQ(*lines[0].figure, 0.9);
    EXPECT_THAT(lines[0].what, HasSubstr("those of few"));
    EXPECT_EQ(lines[0].verdict(), GoalVerdict::Met);
    EXPECT_DOUBLE_EQ(*lines[1].figure, 1.125);
    EXPECT_THAT(lines[1].what, HasSubstr("that of fast"));
    EXPECT_EQ(lines[1].verdict(), GoalVerdict::Missed);
}

}  // namespace
}  // namespace eyepoint::tools
