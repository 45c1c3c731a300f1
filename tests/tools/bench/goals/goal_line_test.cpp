#include "tools/bench/goals/goal_line.hpp"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace eyepoint::tools {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();

TEST(GoalLine, OnTheTargetIsMetAndBeyondItIsMissed) {
    EXPECT_EQ(at_most(1, "", 36000.0, 36000.0).verdict(), GoalVerdict::Met);
    EXPECT_EQ(at_most(1, "", 36001.0, 36000.0).verdict(), GoalVerdict::Missed);
    EXPECT_EQ(at_least(4, "", 99.0, 99.0).verdict(), GoalVerdict::Met);
    EXPECT_EQ(at_least(4, "", 98.9, 99.0).verdict(), GoalVerdict::Missed);
}

TEST(GoalLine, AFigureThatIsNoNumberIsMissed) {
    EXPECT_EQ(at_most(1, "", kNotANumber, 1.0).verdict(), GoalVerdict::Missed);
    EXPECT_EQ(at_least(1, "", kNotANumber, 1.0).verdict(), GoalVerdict::Missed);
}

TEST(GoalLine, WhatWasNotMeasuredIsNeitherMetNorMissed) {
    const GoalLine line = at_most(4, "instructions", std::nullopt, 60.0);
    EXPECT_EQ(line.verdict(), GoalVerdict::NotMeasured);
    EXPECT_THAT(describe(line), EndsWith("not measured"));
    EXPECT_FALSE(any_missed(std::array{line}));
}

TEST(GoalLine, OneMissedLineIsEnough) {
    const std::array lines{at_most(1, "", 1.0, 2.0), at_most(2, "", 3.0, 2.0)};
    EXPECT_TRUE(any_missed(lines));
    EXPECT_FALSE(any_missed(std::span(lines).first(1)));
    EXPECT_FALSE(any_missed({}));
}

TEST(GoalLine, IsGoalFigureTargetAndVerdict) {
    const std::string text = describe(at_most(6, "unfolding", 0.0703, 0.3, "ms"));
    EXPECT_THAT(text, StartsWith(" 6  unfolding "));
    EXPECT_THAT(text, HasSubstr(" 0.0703 ms  at most 0.3 ms "));
    EXPECT_THAT(text, EndsWith("met"));
    EXPECT_THAT(describe(at_least(9, "hidden", 19.0, 30.0, "%")), EndsWith("MISSED"));
}

TEST(GoalLine, PagesAndJsonSayTheSame) {
    const std::array lines{at_most(1, "triangles", 32682.4, 36000.0), at_most(2, "worst", 0.6, 0.5, "px"),
                           at_most(4, "instructions", std::nullopt, 60.0)};
    const std::array<std::string, 1> notes{"A note."};
    const std::string page = markdown(lines, "a machine", notes);
    EXPECT_THAT(page, HasSubstr("| 1 | triangles | 32682 | at most 36000 | met |"));
    EXPECT_THAT(page, HasSubstr("| 2 | worst | 0.6 px | at most 0.5 px | **MISSED** |"));
    EXPECT_THAT(page, HasSubstr("| 4 | instructions | - | at most 60 | not measured |"));
    EXPECT_THAT(page, HasSubstr("\nA note.\n"));
    const auto json = to_json(lines, "a machine", notes);
    EXPECT_EQ(json["machine"], "a machine");
    EXPECT_EQ(json["goals"][0]["verdict"], "met");
    EXPECT_EQ(json["goals"][1]["figure"], 0.6);
    EXPECT_TRUE(json["goals"][2]["figure"].is_null());
}

}  // namespace
}  // namespace eyepoint::tools
