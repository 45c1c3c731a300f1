#include "tools/bench/control/control_score.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "tools/bench/control/control_report.hpp"

namespace eyepoint::tools {
namespace {

std::vector<ControlledFrame> frames_of(const std::vector<double>& costs_ms) {
    std::vector<ControlledFrame> frames;
    for (const double cost_ms : costs_ms)
        frames.push_back({.cost_ms = cost_ms, .tau_px = 1.0, .triangles = 1000});
    return frames;
}

constexpr ig::ControlTarget kBounds{.frame_ms = 10.0, .tau_min_px = 0.5, .tau_max_px = 16.0};

TEST(ControlScore, CountsFramesWithinTenPercentOnBothSides) {
    const auto score = tools::score(frames_of({8.9, 9.1, 10.0, 10.9, 11.1}), kBounds, 10.0, 60.0);
    EXPECT_NEAR(score.share_within, 0.6, 1e-12);
    EXPECT_NEAR(score.share_not_above, 0.8, 1e-12);
    EXPECT_NEAR(score.worst_ratio(), 1.11, 1e-12);
}

TEST(ControlScore, PercentilesAreOfTheFramesThemselves) {
    std::vector<double> costs(100, 10.0);
    costs[3] = 30.0;
    costs[4] = 20.0;
    const auto score = tools::score(frames_of(costs), kBounds, 10.0, 60.0);
    EXPECT_EQ(score.median_ms, 10.0);
    EXPECT_EQ(score.p99_ms, 30.0);
    EXPECT_EQ(score.worst_ms, 30.0);
}

TEST(ControlScore, MeanToleranceIsGeometric) {
    auto frames = frames_of({10.0, 10.0});
    frames[0].tau_px = 0.5;
    frames[1].tau_px = 8.0;
    const auto score = tools::score(frames, kBounds, 10.0, 60.0);
    EXPECT_NEAR(std::exp(score.mean_log_tau), 2.0, 1e-12);
    EXPECT_NEAR(score.share_at_bounds, 0.5, 1e-12);
}

TEST(ControlScore, ReversalsAreTurnsThatGoBackByTwoPercent) {
    auto frames = frames_of(std::vector<double>(6, 10.0));
    const std::vector<double> taus{1.0, 1.2, 1.19, 1.3, 1.1, 1.2};
    for (std::size_t i = 0; i < taus.size(); ++i) frames[i].tau_px = taus[i];
    EXPECT_EQ(reversals(frames), 2U);  // at 1.3 and at 1.1; 1.2 to 1.19 is none
}

TEST(StepScore, SettlesWhereCostsStayNearTheTargetForHalfASecond) {
    std::vector<double> costs(240, 10.0);
    for (std::size_t i = 0; i < 30; ++i) costs[i] = 20.0;
    for (std::size_t i = 40; i < 50; ++i) costs[i] = 12.0;  // not yet settled before
    const auto step = score_step(frames_of(costs), 10.0, 60.0);
    EXPECT_NEAR(step.settle_s, 50.0 / 60.0, 1e-9);
}

TEST(StepScore, OneNoisyFrameIsNotUnsettled) {
    std::vector<double> costs(240, 10.0);
    costs[10] = 20.0;
    EXPECT_EQ(score_step(frames_of(costs), 10.0, 60.0).settle_s, 0.0);
}

TEST(StepScore, NeverSettledTakesTheWholeTime) {
    EXPECT_EQ(score_step(frames_of(std::vector<double>(120, 20.0)), 10.0, 60.0).settle_s, 2.0);
}

TEST(StepScore, OvershootIsOnTheOtherSideOfTheTargetThanTheStep) {
    std::vector<double> up(120, 10.0), down(120, 10.0);
    for (std::size_t i = 0; i < 6; ++i) {
        up[i] = 20.0;
        up[6 + i] = 8.5;
        down[i] = 5.0;
        down[6 + i] = 10.7;
    }
    EXPECT_NEAR(score_step(frames_of(up), 10.0, 60.0).overshoot, 0.15, 1e-9);
    EXPECT_NEAR(score_step(frames_of(down), 10.0, 60.0).overshoot, 0.07, 1e-9);
}

TEST(MiddleFlight, LosesWhatHappenedOnceAndKeepsWhatBelongsToThePlace) {
    const std::vector<std::vector<ControlledFrame>> flights{
        frames_of({10.0, 30.0, 15.0}), frames_of({10.5, 10.0, 15.5}), frames_of({25.0, 10.0, 15.0})};
    const auto middle = middle_flight(flights);
    EXPECT_EQ(middle[0].cost_ms, 10.5);
    EXPECT_EQ(middle[1].cost_ms, 10.0);
    EXPECT_EQ(middle[2].cost_ms, 15.0);
}

TEST(ControlReport, SaysWhatWasUnreachable) {
    TargetRun run{.name = "1000 Hz",
                  .floor_ms = 5.0,
                  .controlled = {frames_of({9.0, 9.0})},
                  .fixed = frames_of({9.0, 9.0}),
                  .each = {},
                  .reuse_share = 0.0,
                  .reuse_share_fixed = 0.0,
                  .middle = {},
                  .beside = {}};
    run.controlled[0][1].state = ig::ControlState::Coarsest;
    run.controlled[0][1].unreachable_share = 0.42;
    run.each.push_back(score(run.controlled[0], kBounds, 1.0, 60.0));
    run.middle = run.beside = run.each.front();
    const std::string text = describe(run);
    EXPECT_NE(text.find("target unreachable: 1 frames"), std::string::npos) << text;
    EXPECT_NE(text.find("42%"), std::string::npos) << text;
    EXPECT_EQ(to_json(run)["controlled"].size(), 1U);
    EXPECT_EQ(to_json(run)["controlled_frames"][0]["tau_px"].size(), 2U);
}

}  // namespace
}  // namespace eyepoint::tools
