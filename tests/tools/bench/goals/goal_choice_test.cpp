#include "tools/bench/goals/goal_choice.hpp"

#include <array>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tools/bench/goals/goal_report.hpp"

namespace eyepoint::tools {
namespace {

using ::testing::HasSubstr;

TEST(GoalChoice, WithoutAWordIsAllGoals) {
    const GoalChoice all;
    for (int goal = 1; goal <= 19; ++goal) EXPECT_TRUE(all.has(goal)) << goal;
    EXPECT_FALSE(all.has(0));
    EXPECT_FALSE(all.has(20));
}

TEST(GoalChoice, NamedGoalsAreChosenAndNoOthers) {
    const auto chosen = GoalChoice::parse("3,8");
    ASSERT_TRUE(chosen.has_value()) << chosen.error();
    EXPECT_TRUE(chosen->has(3));
    EXPECT_TRUE(chosen->has(8));
    EXPECT_FALSE(chosen->has(4));
    EXPECT_TRUE(chosen->has_any(std::array{4, 8}));
    EXPECT_FALSE(chosen->has_any(std::array{4, 7}));
}

TEST(GoalChoice, WhatIsNoGoalIsNamed) {
    for (const char* text : {"0", "20", "three", "3,,8", "3;8", "-1", " 3", "99999999999"}) {
        const auto chosen = GoalChoice::parse(text);
        ASSERT_FALSE(chosen.has_value()) << text;
        EXPECT_THAT(chosen.error(), HasSubstr("is no goal; goals are 1 to 19")) << text;
    }
    EXPECT_FALSE(GoalChoice::parse("").has_value());
}

TEST(GoalReport, DropsLinesOfGoalsThatWereNotAskedFor) {
    std::vector<int> heard;
    GoalReport report(GoalChoice({4}), [&](const GoalLine& line) { heard.push_back(line.goal); });
    report.add(at_most(4, "a", 1.0, 2.0));
    report.add(at_most(7, "b", 1.0, 2.0));
    EXPECT_THAT(heard, ::testing::ElementsAre(4));
    EXPECT_EQ(report.lines().size(), 1U);
}

}  // namespace
}  // namespace eyepoint::tools
