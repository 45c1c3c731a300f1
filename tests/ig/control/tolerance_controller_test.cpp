#include "ig/control/tolerance_controller.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/ig/control/load_simulation.hpp"

namespace eyepoint::ig {
namespace {

constexpr double kTargetMs = 14.0;
constexpr std::size_t kSecond = 60;  // frames
/// Each part of a test: long enough to settle and to see whether it stays so.
constexpr std::size_t kPart = 4 * kSecond;

using Frames = std::span<const SimulatedFrame>;

double off_target(const SimulatedFrame& frame) { return frame.true_ms / kTargetMs - 1.0; }

/// Frames until the true cost stays within 10% of the target for half a second.
std::size_t frames_to_settle(Frames frames) {
    std::size_t since = 0;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        if (std::abs(off_target(frames[i])) > 0.10) since = i + 1;
        if (i + 1 - since >= kSecond / 2) return since;
    }
    return frames.size();
}

/// How far the true cost goes to the other side of the target in the second after a step.
double overshoot(Frames frames) {
    const double side = off_target(frames.front()) > 0.0 ? 1.0 : -1.0;
    double most = 0.0;
    for (const SimulatedFrame& frame : frames.first(kSecond))
        most = std::max(most, -side * off_target(frame));
    return most;
}

/// Turns of tau by more than 2%, from the first second on, a second.
double reversals_per_s(Frames frames) {
    int turns = 0;
    double direction = 0.0, low = std::numeric_limits<double>::infinity(), high = 0.0;
    for (const SimulatedFrame& frame : frames.subspan(kSecond)) {
        low = std::min(low, frame.tau_px);
        high = std::max(high, frame.tau_px);
        const bool up = frame.tau_px > low * 1.02 && direction <= 0.0;
        const bool down = frame.tau_px * 1.02 < high && direction >= 0.0;
        if (!up && !down) continue;
        if (direction != 0.0) ++turns;
        direction = up ? 1.0 : -1.0;
        low = high = frame.tau_px;
    }
    return turns / (static_cast<double>(frames.size() - kSecond) / kSecond);
}

double share_within(Frames frames) {
    const auto within =
        std::ranges::count_if(frames, [](const auto& frame) { return std::abs(off_target(frame)) <= 0.10; });
    return static_cast<double>(within) / static_cast<double>(frames.size());
}

ControlTarget target() {
    return {.frame_ms = kTargetMs, .tau_min_px = 0.2, .tau_max_px = 50.0, .nominal_tau_px = 2.0};
}

/// A number of 0..1 from a generator, so that failing cases shrink to the low end.
double fraction() { return *rc::gen::inRange(0, 1001) / 1000.0; }

/// A scene of any split between pixels and triangles that can meet the target, with any noise.
Simulation any_scene() {
    SimulatedLoad load;
    load.pixels_ms = 2.0 + 2.5 * fraction();
    const double tau_at_target = 1.0 + fraction();
    Simulation simulation{.target = target(), .frames = 3 * kPart, .load = {}};
    simulation.slope = 0.75 + 0.45 * fraction();
    load.ms_a_triangle =
        (kTargetMs - load.pixels_ms) / (load.demand * std::pow(tau_at_target, -simulation.slope));
    simulation.noise = 0.005 + 0.035 * fraction();
    simulation.demand_noise = 0.01 * fraction();
    simulation.spike_chance = 0.02 * fraction();
    simulation.delay = *rc::gen::inRange<std::size_t>(0, 2);
    simulation.seed = *rc::gen::inRange<std::uint32_t>(1, 1'000'000);
    simulation.load = [load](std::size_t) { return load; };
    return simulation;
}

/// The scene with costs as the second of three parts has them.
template <typename Change>
Simulation with_step(Simulation simulation, Change change) {
    simulation.load = [steady = simulation.load, change](std::size_t frame) {
        SimulatedLoad load = steady(frame);
        if (frame >= kPart && frame < 2 * kPart) change(load);
        return load;
    };
    return simulation;
}

void expect_settled(Frames frames) {
    for (std::size_t part = 0; part < 3; ++part) {
        const Frames span = frames.subspan(part * kPart, kPart);
        RC_ASSERT(frames_to_settle(span) <= kSecond);
        RC_ASSERT(reversals_per_s(span) <= 1.0);
        if (part > 0) RC_ASSERT(overshoot(span) <= 0.20);
    }
    for (const SimulatedFrame& frame : frames)
        RC_ASSERT(frame.tau_px >= target().tau_min_px && frame.tau_px <= target().tau_max_px);
}

RC_GTEST_PROP(ToleranceController, SettlesWithinASecondWhenTheProcessorGetsTwiceAsSlowAndFastAgain, ()) {
    expect_settled(simulate(with_step(any_scene(), [](SimulatedLoad& load) {
        load.pixels_ms *= 2.0;
        load.ms_a_triangle *= 2.0;
    })));
}

RC_GTEST_PROP(ToleranceController, SettlesWithinASecondWhenThePixelsDoubleAndHalveAgain, ()) {
    expect_settled(simulate(with_step(any_scene(), [](SimulatedLoad& load) { load.pixels_ms *= 2.0; })));
}

RC_GTEST_PROP(ToleranceController, SettlesWithinASecondWhenTheTrianglesAskedForDoubleAndHalveAgain, ()) {
    expect_settled(simulate(with_step(any_scene(), [](SimulatedLoad& load) { load.demand *= 2.0; })));
}

RC_GTEST_PROP(ToleranceController, FollowsARampOfFourTimesTheDemandInFiveSeconds, ()) {
    Simulation simulation = any_scene();
    constexpr std::size_t kRamp = 5 * kSecond;
    simulation.frames = 4 * kRamp;
    simulation.load = [steady = simulation.load](std::size_t frame) {
        const double place = static_cast<double>(frame % (2 * kRamp)) / kRamp;  // up, then down
        SimulatedLoad load = steady(frame);
        load.demand *= std::pow(4.0, place <= 1.0 ? place : 2.0 - place);
        return load;
    };
    const auto frames = simulate(simulation);
    RC_ASSERT(share_within(Frames(frames).subspan(kSecond)) >= 0.97);
}

RC_GTEST_PROP(ToleranceController, FollowsASquareWaveOfHalfAsMuchAgainEveryTwoSeconds, ()) {
    Simulation simulation = any_scene();
    constexpr std::size_t kHalfWave = 2 * kSecond;
    simulation.frames = 6 * kHalfWave;
    simulation.load = [steady = simulation.load](std::size_t frame) {
        SimulatedLoad load = steady(frame);
        if (frame / kHalfWave % 2 == 1) load.ms_a_triangle *= 1.5;
        return load;
    };
    const auto frames = simulate(simulation);
    for (std::size_t start = 0; start < frames.size(); start += kHalfWave)
        RC_ASSERT(frames_to_settle(Frames(frames).subspan(start, kHalfWave)) <= kSecond);
}

Simulation plain_scene() {
    Simulation simulation{.target = target(), .frames = 2 * kPart, .load = {}};
    simulation.load = [](std::size_t) { return SimulatedLoad{}; };
    return simulation;
}

TEST(ToleranceController, StandsStillOnASteadyLoad) {
    Simulation simulation = plain_scene();
    simulation.noise = 0.0;
    const auto frames = simulate(simulation);
    for (std::size_t i = kSecond; i < frames.size(); ++i) EXPECT_EQ(frames[i].tau_px, frames[kSecond].tau_px);
    EXPECT_EQ(frames.back().decision.state, ControlState::Steady);
}

TEST(ToleranceController, ASingleSpikeMovesNothing) {
    Simulation simulation = plain_scene();
    simulation.noise = 0.0;
    simulation.load = [](std::size_t frame) {
        SimulatedLoad load;
        if (frame == kPart) load.pixels_ms += 30.0;
        return load;
    };
    const auto frames = simulate(simulation);
    EXPECT_EQ(frames[kPart + 1].tau_px, frames[kPart].tau_px);
    EXPECT_EQ(frames.back().tau_px, frames[kPart].tau_px);
}

TEST(ToleranceController, TheSecondFrameOfAStepMovesIt) {
    Simulation simulation = plain_scene();
    simulation.load = [](std::size_t frame) {
        SimulatedLoad load;
        if (frame >= kPart) load.pixels_ms += 10.0;
        return load;
    };
    const auto frames = simulate(simulation);
    EXPECT_EQ(frames[kPart + 1].tau_px, frames[kPart].tau_px);
    EXPECT_GT(frames[kPart + 2].tau_px, 1.2 * frames[kPart].tau_px);
}

TEST(ToleranceController, ABurstOfUploadsLeavesTheToleranceAsItWas) {
    Simulation simulation = plain_scene();
    simulation.noise = 0.0;
    simulation.load = [](std::size_t frame) {
        SimulatedLoad load;
        if (frame >= kPart && frame < kPart + 4) load.pixels_ms += 15.0;
        return load;
    };
    const auto frames = simulate(simulation);
    EXPECT_GT(frames[kPart + 3].tau_px, frames[kPart].tau_px);
    EXPECT_NEAR(frames[kPart + 5].tau_px, frames[kPart].tau_px, 1e-9);
}

TEST(ToleranceController, AnUnreachableTargetIsDrawnAtTheCoarsestToleranceAndSaidWithTheShareMissing) {
    Simulation simulation = plain_scene();
    simulation.load = [](std::size_t) {
        return SimulatedLoad{.pixels_ms = 16.0, .ms_a_triangle = 2e-4};  // 0.32 ms of terrain at tau 50
    };
    const auto frames = simulate(simulation);
    EXPECT_EQ(frames.back().decision.state, ControlState::Coarsest);
    EXPECT_NEAR(frames.back().tau_px, target().tau_max_px, 0.01);
    EXPECT_NEAR(frames.back().decision.unreachable_share, 16.32 / kTargetMs - 1.0, 0.03);
}

TEST(ToleranceController, DoesNotWindUpAtABound) {
    Simulation simulation = plain_scene();
    simulation.frames = 20 * kSecond;
    const std::size_t end = 15 * kSecond;
    simulation.load = [=](std::size_t frame) {
        SimulatedLoad load;
        if (frame >= kSecond && frame < end) load.pixels_ms = 20.0;
        return load;
    };
    const auto frames = simulate(simulation);
    ASSERT_EQ(frames[end - 1].decision.state, ControlState::Coarsest);
    EXPECT_LE(frames_to_settle(Frames(frames).subspan(end)), kSecond);
}

TEST(ToleranceController, DoesNotCoarsenInVainWhenTheTerrainCostsNextToNothing) {
    Simulation simulation = plain_scene();
    simulation.load = [](std::size_t) { return SimulatedLoad{.pixels_ms = 20.0, .ms_a_triangle = 1e-5}; };
    const auto frames = simulate(simulation);
    EXPECT_EQ(frames.back().decision.state, ControlState::Held);
    EXPECT_NEAR(frames.back().tau_px, target().nominal_tau_px, 0.05);
    EXPECT_NEAR(frames.back().decision.unreachable_share, 20.4 / kTargetMs - 1.0, 0.05);
}

TEST(ToleranceController, KeepsTheToleranceThatMetTheTargetWhenAnOutputTakesAllTheTime) {
    Simulation simulation = plain_scene();
    simulation.load = [](std::size_t frame) {
        return SimulatedLoad{
            .pixels_ms = 12.0, .ms_a_triangle = 1e-5, .other_ms = frame < kPart ? 0.0 : 60.0};
    };
    const auto frames = simulate(simulation);
    const double before_px = frames[kPart - 1].tau_px;
    EXPECT_EQ(frames.back().decision.state, ControlState::Held);
    EXPECT_NEAR(frames.back().tau_px, before_px, 0.05 * before_px);
}

TEST(ToleranceController, RefinesNoFurtherThanTheLeastTolerance) {
    Simulation simulation = plain_scene();
    simulation.load = [](std::size_t) { return SimulatedLoad{.pixels_ms = 1.0, .ms_a_triangle = 1e-6}; };
    const auto frames = simulate(simulation);
    EXPECT_EQ(frames.back().decision.state, ControlState::Finest);
    EXPECT_NEAR(frames.back().tau_px, target().tau_min_px, 1e-6);
}

TEST(ToleranceController, DoesNotRefineWhileTheTerrainItHasAskedForIsLoading) {
    ToleranceController controller(target());
    ControlDecision decision;
    for (int i = 0; i < 100; ++i)
        decision = controller.next({.tau_px = controller.tau_px(),
                                    .triangles = 1000.0,
                                    .cost_ms = 4.0,
                                    .other_ms = 0.0,
                                    .awaits_terrain = true});
    EXPECT_EQ(decision.state, ControlState::AwaitingTerrain);
    EXPECT_EQ(decision.tau_px, target().nominal_tau_px);
}

TEST(ToleranceController, LeavesOutFramesThatAreNoMeasurement) {
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    ToleranceController controller(target());
    const auto after = [&](const FrameCost& frame) { return controller.next(frame).tau_px; };
    EXPECT_EQ(after({2.0, 1e4, kNan, 0.0, false}), 2.0);
    EXPECT_EQ(after({2.0, 1e4, 0.0, 0.0, false}), 2.0);
    EXPECT_EQ(after({2.0, 0.0, 1e9, 0.0, false}), 2.0);
    EXPECT_EQ(after({0.0, 1e4, 1e9, 0.0, false}), 2.0);
    EXPECT_EQ(after({2.0, 1e4, 1e9, kNan, false}), 2.0);
}

TEST(ToleranceController, EqualFramesGiveEqualTolerances) {
    const auto first = simulate(plain_scene()), second = simulate(plain_scene());
    for (std::size_t i = 0; i < first.size(); ++i) ASSERT_EQ(first[i].tau_px, second[i].tau_px);
}

TEST(CostModel, TellsPixelsFromTrianglesOnceBothSizesWereSeen) {
    CostModel model;
    for (int i = 0; i < 60; ++i) {
        const double triangles = i % 2 == 0 ? 20000.0 : 40000.0;
        (void)model.learn(triangles, 8.0 + 2e-4 * triangles);
    }
    EXPECT_NEAR(model.fixed_ms(), 8.0, 0.2);
    EXPECT_NEAR(model.terrain_ms(30000.0), 6.0, 0.2);
}

TEST(CostModel, KeepsTheSplitWhileTheTrianglesStandStill) {
    CostModel model;
    for (int i = 0; i < 60; ++i) {
        const double triangles = i % 2 == 0 ? 20000.0 : 40000.0;
        (void)model.learn(triangles, 8.0 + 2e-4 * triangles);
    }
    for (int i = 0; i < 3600; ++i) (void)model.learn(30000.0, 14.0);
    EXPECT_NEAR(model.fixed_ms(), 8.0, 0.3);
}

TEST(CostModel, LearnsHowNoisyCostsAre) {
    std::mt19937 random(3);
    std::normal_distribution<double> normal;
    CostModel model;
    for (int i = 0; i < 600; ++i) (void)model.learn(30000.0, 14.0 * (1.0 + 0.05 * normal(random)));
    EXPECT_NEAR(model.noise_share(), 0.05, 0.02);
}

TEST(TriangleSlope, IsFoundWhileTheDemandDrifts) {
    TriangleSlope slope;
    for (int i = 0; i < 200; ++i) {
        const double tau = 2.0 * std::exp(0.2 * std::sin(i * 0.9));
        slope.learn(tau, 50000.0 * std::exp(0.01 * i) * std::pow(tau, -0.7));
    }
    EXPECT_NEAR(slope.slope(), 0.7, 0.02);
}

TEST(TriangleSlope, IsNotForgottenWhileAControllerKeepsTheTrianglesStill) {
    TriangleSlope slope;
    for (int i = 0; i < 2000; ++i) slope.learn(2.0 * std::exp(0.001 * i), 50000.0);  // tau follows the demand
    EXPECT_NEAR(slope.slope(), 1.0, 1e-9);
}

}  // namespace
}  // namespace eyepoint::ig
