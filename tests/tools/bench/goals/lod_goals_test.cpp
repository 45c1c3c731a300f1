/// Goals of what level of detail draws and what choosing takes, from figures made up for the purpose.
#include <array>

#include <gtest/gtest.h>

#include "tools/bench/goals/block_goals.hpp"
#include "tools/bench/goals/control_goals.hpp"
#include "tools/bench/goals/mesh_goals.hpp"
#include "tools/bench/goals/selection_goals.hpp"

namespace eyepoint::tools {
namespace {

TEST(MeshGoals, APostBeyondToleranceAndSlackIsMissed) {
    EXPECT_EQ(post_error_goal(2.0, 0.1, 2.19).verdict(), GoalVerdict::Met);
    EXPECT_EQ(post_error_goal(2.0, 0.1, 2.21).verdict(), GoalVerdict::Missed);
    EXPECT_EQ(post_error_goal(2.0, 0.0, 2.19).verdict(), GoalVerdict::Missed);
}

TEST(MeshGoals, JumpsAreHeldToAQuarterOfAPixel) {
    EXPECT_EQ(jump_goal(1.85, 0.25).verdict(), GoalVerdict::Met);
    EXPECT_EQ(jump_goal(1.85, 0.26).verdict(), GoalVerdict::Missed);
}

FlightFigures selection_of(double ns_a_block) {
    FlightFigures figures;
    figures.median_ns_per_block = ns_a_block;
    figures.selection_us_median = 10.0;
    figures.blocks_drawn_mean = 200.0;
    figures.reused_share = 0.995;
    return figures;
}

TEST(SelectionGoals, AreTakenAtOnePixelAndFlatnessOverAllTolerances) {
    std::array flights{SelectionAtTau{0.25, selection_of(12.0)}, SelectionAtTau{1.0, selection_of(9.0)},
                       SelectionAtTau{4.0, selection_of(10.0)}};
    flights[2].figures.allocations = 3;
    const auto lines = selection_goals(flights);
    ASSERT_EQ(lines.size(), 5U);
    EXPECT_DOUBLE_EQ(*lines[0].figure, 9.0);
    EXPECT_DOUBLE_EQ(*lines[1].figure, 20.0) << "10 us for 200 blocks";
    EXPECT_DOUBLE_EQ(*lines[2].figure, 99.5);
    EXPECT_DOUBLE_EQ(*lines[3].figure, 12.0 / 9.0);
    EXPECT_EQ(lines[3].verdict(), GoalVerdict::Missed);
    EXPECT_EQ(lines[4].goal, 7);
    EXPECT_EQ(lines[4].verdict(), GoalVerdict::Missed) << "one tolerance allocates";
}

TEST(SelectionGoals, InstructionsMayBeUnknown) {
    EXPECT_EQ(instructions_goal(60.0).verdict(), GoalVerdict::Met);
    EXPECT_EQ(instructions_goal(61.0).verdict(), GoalVerdict::Missed);
    EXPECT_EQ(instructions_goal(std::nullopt).verdict(), GoalVerdict::NotMeasured);
}

TEST(BlockGoals, AreTimeSizeAndTheCompilersPace) {
    EXPECT_EQ(compiler_goal(7.9).verdict(), GoalVerdict::Missed);
    EXPECT_EQ(compiler_goal(8.1).verdict(), GoalVerdict::Met);
    EXPECT_EQ(block_goals({.median_ms = 0.31, .mesh_bits_a_post = 4.0})[0].verdict(), GoalVerdict::Missed);
    EXPECT_EQ(block_goals({.median_ms = 0.29, .mesh_bits_a_post = 9.0})[1].verdict(), GoalVerdict::Missed);
}

TEST(ControlGoals, AreShareWorstAndTail) {
    const auto lines = control_goals(
        {.target_ms = 10.0, .median_ms = 10.0, .p99_ms = 12.6, .worst_ms = 12.4, .share_within = 0.96});
    ASSERT_EQ(lines.size(), 3U);
    EXPECT_EQ(lines[0].verdict(), GoalVerdict::Met);
    EXPECT_EQ(lines[1].verdict(), GoalVerdict::Met);
    EXPECT_EQ(lines[2].verdict(), GoalVerdict::Missed);
}

}  // namespace
}  // namespace eyepoint::tools
