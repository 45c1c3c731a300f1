#include "tools/bench/goals/drawing_goals.hpp"

#include <array>

#include <gtest/gtest.h>

namespace eyepoint::tools {
namespace {

TEST(DrawingGoals, RatiosAreMediansOverEyesOfFramesBesideEachOther) {
    // The machine was three times slower at the second eye, for both.
    const std::array tile{TurnFrame{.cpu_ms = 100.0}, TurnFrame{.cpu_ms = 300.0}, TurnFrame{.cpu_ms = 100.0}};
    const std::array method{TurnFrame{.cpu_ms = 45.0}, TurnFrame{.cpu_ms = 135.0}, TurnFrame{.cpu_ms = 90.0}};
    EXPECT_DOUBLE_EQ(frame_ratio({tile, method}), 0.45);
    EXPECT_EQ(tile_goal({tile, method}).verdict(), GoalVerdict::Met);
    EXPECT_EQ(tile_goal({method, tile}).verdict(), GoalVerdict::Missed);
    EXPECT_EQ(tile_morph_goal({tile, method}).verdict(), GoalVerdict::Met);
    EXPECT_EQ(tile_morph_goal({method, tile}).verdict(), GoalVerdict::Missed);
}

TEST(DrawingGoals, AFrameIsHeldToAFifthAboveItsFloor) {
    const std::array near{TurnFrame{.cpu_ms = 119.0, .floor_cpu_ms = 100.0}};
    const std::array far{TurnFrame{.cpu_ms = 121.0, .floor_cpu_ms = 100.0}};
    EXPECT_EQ(floor_goal(near).verdict(), GoalVerdict::Met);
    EXPECT_EQ(floor_goal(far).verdict(), GoalVerdict::Missed);
}

TEST(DrawingGoals, MorphIsHeldToTwoPercentAndEightBytes) {
    const std::array without{TurnFrame{.cpu_ms = 100.0}}, with{TurnFrame{.cpu_ms = 103.0}};
    const auto lines = morph_goals({without, with});
    EXPECT_NEAR(*lines[0].figure, 3.0, 1e-9);
    EXPECT_EQ(lines[0].verdict(), GoalVerdict::Missed);
    EXPECT_EQ(lines[1].verdict(), GoalVerdict::Met);
}

}  // namespace
}  // namespace eyepoint::tools
