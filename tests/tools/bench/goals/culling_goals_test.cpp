#include "tools/bench/goals/culling_goals.hpp"

#include <array>

#include <gtest/gtest.h>

namespace eyepoint::tools {
namespace {

TEST(CullingGoals, WhatIsHiddenIsAShareOfAllTriangles) {
    FlightFigures culled;
    culled.triangles_mean = 60.0;
    culled.hidden_mean = 40.0;
    EXPECT_DOUBLE_EQ(*hidden_goal("cruise", culled, 30.0).figure, 40.0);
    EXPECT_EQ(hidden_goal("cruise", culled, 65.0).verdict(), GoalVerdict::Missed);
    EXPECT_DOUBLE_EQ(*hidden_goal("nothing drawn", FlightFigures{}, 30.0).figure, 0.0);
}

TEST(CullingGoals, OnePixelIsEnoughToMiss) {
    std::array frames{TurnFrame{}, TurnFrame{}};
    EXPECT_EQ(unchanged_goal(frames).verdict(), GoalVerdict::Met);
    frames[1].pixels_changed = 1;
    EXPECT_EQ(unchanged_goal(frames).verdict(), GoalVerdict::Missed);
}

TEST(CullingGoals, ThePriceIsSelectionOverTheRestOfTheFrame) {
    // Selection takes 0.5 ms more; the rest of the frame 10 ms less.
    const std::array whole{TurnFrame{.cpu_ms = 50.1, .selection_ms = 0.1}};
    const std::array culled{TurnFrame{.cpu_ms = 40.6, .selection_ms = 0.6}};
    EXPECT_NEAR(*culling_price_goal("cruise", whole, culled).figure, 5.0, 1e-9);
    EXPECT_EQ(culling_price_goal("cruise", whole, culled).verdict(), GoalVerdict::Met);
}

TEST(CullingGoals, ACostThatSavesNothingIsMissed) {
    const std::array whole{TurnFrame{.cpu_ms = 50.0, .selection_ms = 0.1}};
    const std::array culled{TurnFrame{.cpu_ms = 51.0, .selection_ms = 0.6}};
    EXPECT_EQ(culling_price_goal("cruise", whole, culled).verdict(), GoalVerdict::Missed);
}

TEST(CullingGoals, WhereNothingIsHiddenATenthOfAMillisecondIsAllowed) {
    FlightFigures whole, dear, cheap;
    whole.selection_us_mean = 100.0;
    dear.selection_us_mean = 201.0;
    cheap.selection_us_mean = 199.0;
    EXPECT_EQ(culling_cost_goal("down", whole, cheap).verdict(), GoalVerdict::Met);
    EXPECT_EQ(culling_cost_goal("down", whole, dear).verdict(), GoalVerdict::Missed);
}

}  // namespace
}  // namespace eyepoint::tools
