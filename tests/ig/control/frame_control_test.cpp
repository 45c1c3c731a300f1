#include "ig/control/frame_control.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "ig/control/timer_query_check.hpp"

namespace eyepoint::ig {
namespace {

using testing::HasSubstr;

constexpr std::int64_t kSecondNs = 1'000'000'000;

config::Settings settings_with(config::TauControl control, config::OutputKind output) {
    config::Settings settings;
    settings.control.tolerance = control;
    settings.output.kind = output;
    return settings;
}

bool controls(config::TauControl control, config::OutputKind output) {
    const auto target = control_target(settings_with(control, output));
    return target.has_value() && target->has_value();
}

TEST(ControlTarget, AutomaticIsOnInAWindowAndOffWherePicturesMustNotDependOnTheMachine) {
    using config::OutputKind, config::TauControl;
    EXPECT_TRUE(controls(TauControl::Automatic, OutputKind::Window));
    EXPECT_FALSE(controls(TauControl::Automatic, OutputKind::Pictures));
    EXPECT_FALSE(controls(TauControl::Automatic, OutputKind::Video));
    EXPECT_FALSE(controls(TauControl::Automatic, OutputKind::None));
    EXPECT_TRUE(controls(TauControl::On, OutputKind::None));
    EXPECT_FALSE(controls(TauControl::Off, OutputKind::Window));
}

TEST(ControlTarget, AutomaticIsOffWhereFramesAreNotPaced) {
    config::Settings settings = settings_with(config::TauControl::Automatic, config::OutputKind::Window);
    settings.frame.pacing = config::Pacing::Free;
    EXPECT_FALSE(control_target(settings).value().has_value());
}

TEST(ControlTarget, IsTheShareOfThePeriod) {
    config::Settings settings = settings_with(config::TauControl::On, config::OutputKind::None);
    settings.frame.rate_hz = 50.0;
    settings.control.target_share = 0.8;
    settings.terrain.tau_px = 3.0;
    const auto target = control_target(settings).value().value();
    EXPECT_NEAR(target.frame_ms, 16.0, 1e-12);
    EXPECT_EQ(target.nominal_tau_px, 3.0);
}

TEST(ControlTarget, BoundsTheWrongWayRoundAreAnErrorThatNamesBoth) {
    config::Settings settings = settings_with(config::TauControl::On, config::OutputKind::None);
    settings.control.tau_min_px = 8.0;
    settings.control.tau_max_px = 4.0;
    const auto target = control_target(settings);
    ASSERT_FALSE(target.has_value());
    EXPECT_THAT(target.error(), HasSubstr("control.tau_min_px"));
    EXPECT_THAT(target.error(), HasSubstr("control.tau_max_px"));
}

TEST(CostOf, TakesTheFrameToItsFenceAndTheOutputBesideIt) {
    FrameEntry entry;
    entry.frame_ms = 12.0;
    entry.output_ms = 3.0;
    entry.drawn.tau_px = 1.5;
    entry.drawn.triangles = 40000;
    entry.drawn.blocks_drawn = 80;
    entry.drawn.loads_pending = 10;
    const FrameCost cost = cost_of(entry);
    EXPECT_EQ(cost.cost_ms, 12.0);
    EXPECT_EQ(cost.other_ms, 3.0);
    EXPECT_EQ(cost.tau_px, 1.5);
    EXPECT_EQ(cost.triangles, 40000.0);
    EXPECT_FALSE(cost.awaits_terrain);
    entry.drawn.loads_pending = 11;
    EXPECT_TRUE(cost_of(entry).awaits_terrain);
}

constexpr ControlDecision kMet{2.0, ControlState::Steady, 0.0};
constexpr ControlDecision kCoarsest{16.0, ControlState::Coarsest, 0.18};
constexpr ControlDecision kHeld{2.0, ControlState::Held, 0.42};
constexpr ControlTarget kTarget{.frame_ms = 14.2, .tau_max_px = 16.0};

TEST(ControlLog, IsSilentWhileTheTargetIsMetAndOfShortTrouble) {
    ControlLog log(kTarget);
    EXPECT_FALSE(log.line(kMet, 0));
    EXPECT_FALSE(log.line(kCoarsest, 1));
    EXPECT_FALSE(log.line(kCoarsest, kSecondNs / 2));
    EXPECT_FALSE(log.line(kMet, kSecondNs));
    EXPECT_FALSE(log.line(kCoarsest, kSecondNs + 2));
}

TEST(ControlLog, SaysByHowMuchTheTargetIsMissedAndWhatToDo) {
    ControlLog log(kTarget);
    EXPECT_FALSE(log.line(kCoarsest, 0));
    const auto line = log.line(kCoarsest, kSecondNs);
    ASSERT_TRUE(line.has_value());
    EXPECT_THAT(*line, HasSubstr("18%"));
    EXPECT_THAT(*line, HasSubstr("14.2 ms"));
    EXPECT_THAT(*line, HasSubstr("16 px: target unreachable"));
    EXPECT_THAT(*line, HasSubstr("frame.rate_hz"));
}

TEST(ControlLog, SaysThatTheToleranceIsHeldWhereTheTerrainIsNotToBlame) {
    ControlLog log(kTarget);
    (void)log.line(kHeld, 0);
    const auto line = log.line(kHeld, kSecondNs);
    ASSERT_TRUE(line.has_value());
    EXPECT_THAT(*line, HasSubstr("42%"));
    EXPECT_THAT(*line, HasSubstr("held at 2.00 px"));
}

TEST(ControlLog, RepeatsItselfOnceAMinuteAndSaysWhenItIsOver) {
    ControlLog log(kTarget);
    int lines = 0;
    for (std::int64_t s = 0; s <= 180; ++s) lines += log.line(kCoarsest, s * kSecondNs) ? 1 : 0;
    EXPECT_EQ(lines, 3);
    EXPECT_FALSE(log.line(kMet, 181 * kSecondNs));
    const auto over = log.line(kMet, 182 * kSecondNs);
    ASSERT_TRUE(over.has_value());
    EXPECT_THAT(*over, HasSubstr("again"));
    EXPECT_FALSE(log.line(kMet, 400 * kSecondNs));
}

TEST(TimerQueries, AgreeWhenTheySeeAlmostAllOfTheWork) {
    EXPECT_TRUE(timers_agree(9.5, 10.0));
    EXPECT_FALSE(timers_agree(2.8, 10.0));   // a software renderer's
    EXPECT_FALSE(timers_agree(12.0, 10.0));  // longer than it took
    EXPECT_FALSE(timers_agree(0.1, 0.1));    // too short to tell
}

TEST(TimerQueries, AreDescribedWithWhatIsUsedInstead) {
    EXPECT_THAT(describe(std::nullopt), HasSubstr("fences"));
    EXPECT_THAT(describe(TimerQueryCheck{2.8, 10.0, false}), HasSubstr("2.80 ms of 10.00"));
    EXPECT_THAT(describe(TimerQueryCheck{9.5, 10.0, true}), HasSubstr("agree"));
}

}  // namespace
}  // namespace eyepoint::ig
