#include "tools/bench/goals/frame_goals.hpp"

#include <algorithm>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace eyepoint::tools {
namespace {

constexpr double kAbsent = std::numeric_limits<double>::quiet_NaN();

FlightResult result_of() {
    FlightResult result;
    result.frames = 4;
    result.columns = {
        {"cpu_ms", {10.0, 10.0, 10.0, 14.0}},     {"still_cpu_ms", {8.0, kAbsent, 8.0, kAbsent}},
        {"outside_gl_ms", {0.2, 0.2, 0.2, 0.2}},  {"triangles", {12500.0, 12500.0, 12500.0, 12500.0}},
        {"allocations", {100.0, 5.0, 3.0, 7.0}},  {"blocks_uploaded", {0.0, 0.0, 0.0, 2.0}},
        {"new_state_pairs", {3.0, 0.0, 1.0, 0.0}}};
    result.figures = {{"readback_ms", 0.33}, {"copy_ms", 0.3}};
    return result;
}

double figure_of(const std::string& what) {
    for (const GoalLine& line : frame_goals(result_of()))
        if (line.what.starts_with(what)) return line.figure.value();
    return kAbsent;
}

TEST(FrameGoals, AreFiguresOfTheFlight) {
    EXPECT_DOUBLE_EQ(figure_of("frame CPU over that of a static mesh"), 1.25);
    EXPECT_DOUBLE_EQ(figure_of("frame CPU, p99 over median"), 1.4);
    EXPECT_DOUBLE_EQ(figure_of("frame thread outside GL at 25,000 triangles"), 0.4);
    EXPECT_DOUBLE_EQ(figure_of("reading a frame back"), 1.1);
}

TEST(FrameGoals, SteadyFramesUploadNothingAndDoNotFollowAStaticMeshOrTheStart) {
    EXPECT_EQ(figure_of("heap allocations"), 3.0);
    EXPECT_EQ(figure_of("new programs and state pairs"), 1.0);
}

TEST(FrameGoals, ADearFrameMissesItsGoalAndACheapOneMeetsIt) {
    FlightResult dear = result_of();
    const auto verdict = [](const FlightResult& result) { return price_goals(result).front().verdict(); };
    EXPECT_EQ(verdict(dear), GoalVerdict::Missed);
    dear.columns["still_cpu_ms"] = {9.5, kAbsent, 9.5, kAbsent};
    EXPECT_EQ(verdict(dear), GoalVerdict::Met);
}

TEST(FrameGoals, WhatWasNotMeasuredHasNoLine) { EXPECT_TRUE(frame_goals(FlightResult{}).empty()); }

}  // namespace
}  // namespace eyepoint::tools
