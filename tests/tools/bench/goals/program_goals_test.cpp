#include "tools/bench/goals/program_goals.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace eyepoint::tools {
namespace {

TEST(ProgramGoals, EachPacketCountsOnceAndTheHeaderNot) {
    const std::string record =
        "{\"eyepoint_record\":1}\n"
        "{\"frame\":1,\"new_packet\":true,\"arrival_to_complete_ms\":20.5}\n"
        "{\"frame\":2,\"new_packet\":false,\"arrival_to_complete_ms\":37.0}\n"
        "{\"frame\":3,\"new_packet\":true,\"arrival_to_complete_ms\":21.0}\n"
        "{\"frame\":4,\"new_pac";
    EXPECT_THAT(delays_of_record(record), ::testing::ElementsAre(20.5, 21.0));
}

TEST(ProgramGoals, TheDelayIsTwoPeriodsAndAMillisecondForAllButOneInAHundred) {
    std::vector<double> delays(100, 34.0);
    delays[7] = 100.0;
    EXPECT_EQ(delay_goal(delays).verdict(), GoalVerdict::Met);
    delays[8] = 34.4;
    EXPECT_EQ(delay_goal(delays).verdict(), GoalVerdict::Missed);
    EXPECT_EQ(delay_goal({}).verdict(), GoalVerdict::NotMeasured);
}

TEST(ProgramGoals, AnIdleProgramMayTakeTwoPercent) {
    EXPECT_EQ(idle_goal(1.9).verdict(), GoalVerdict::Met);
    EXPECT_EQ(idle_goal(2.1).verdict(), GoalVerdict::Missed);
}

}  // namespace
}  // namespace eyepoint::tools
