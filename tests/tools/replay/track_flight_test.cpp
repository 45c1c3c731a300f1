#include "tools/replay/track_flight.hpp"

#include <cmath>
#include <numbers>

#include <GeographicLib/LocalCartesian.hpp>
#include <gtest/gtest.h>

namespace eyepoint::tools {
namespace {

constexpr double kRadian = 180.0 / std::numbers::pi;

// A right-hand circle of 300 m radius at 30 m/s, one fix a second, beginning northwards.
Track circle() {
    const GeographicLib::LocalCartesian frame(46.5, 8.25, 2000.0);
    Track track;
    for (int t = 0; t <= 120; ++t) {
        const double angle = 30.0 * t / 300.0;
        TrackFix fix;
        fix.time_s = t;
        frame.Reverse(300.0 * (1.0 - std::cos(angle)), 300.0 * std::sin(angle), 0.0, fix.latitude_deg,
                      fix.longitude_deg, fix.altitude_m);
        track.fixes.push_back(fix);
    }
    return track;
}

TEST(SampleFlight, ACircleIsFlownWithTheBankOfACoordinatedTurn) {
    const auto samples = sample_flight(circle(), {.rate_hz = 30.0});
    ASSERT_EQ(samples.size(), 3601U);
    const double bank = std::atan(30.0 * 30.0 / 300.0 / 9.80665) * kRadian;
    for (std::size_t i = 300; i + 300 < samples.size(); ++i) {
        const auto& fdm = samples[i].fdm;
        // Smoothing of 0.75 s (twice) in a turn of 5.7 degrees a second takes 0.6 % off the bank's tangent.
        EXPECT_NEAR(fdm.attitude.roll_deg, bank, 0.3);
        EXPECT_NEAR(fdm.attitude.pitch_deg, 0.0, 0.2);
        const double course = 30.0 * samples[i].time_s / 300.0 * kRadian;
        EXPECT_NEAR(std::remainder(fdm.attitude.yaw_deg - course, 360.0), 0.0, 0.3);
        EXPECT_NEAR(fdm.attitude_rate.yaw_deg, 0.1 * kRadian, 0.1);
        EXPECT_NEAR(std::hypot(fdm.velocity_ned_mps[0], fdm.velocity_ned_mps[1]), 30.0, 0.2);
    }
}

TEST(SampleFlight, TakesThePartAskedForAndTheOffset) {
    const auto samples = sample_flight(
        circle(), {.rate_hz = 10.0, .from_s = 20.0, .until_s = 30.0, .altitude_offset_m = -50.0});
    ASSERT_EQ(samples.size(), 101U);
    EXPECT_DOUBLE_EQ(samples.front().time_s, 20.0);
    EXPECT_DOUBLE_EQ(samples.back().time_s, 30.0);
    EXPECT_NEAR(samples.front().fdm.altitude_m, 1950.0, 0.1);
    EXPECT_TRUE(sample_flight(circle(), {.from_s = 500.0}).empty());
    EXPECT_TRUE(sample_flight(circle(), {.from_s = 30.0, .until_s = 20.0}).empty());
}

TEST(SampleFlight, AttitudesOfTheLogAreKeptAndTurnTheShortWay) {
    Track track = circle();
    for (TrackFix& fix : track.fixes)
        fix.attitude = net::AttitudeDeg{fix.time_s < 1.0 ? 350.0 : 10.0, 5.0, -40.0};
    const auto samples = sample_flight(track, {.rate_hz = 10.0});
    EXPECT_NEAR(std::remainder(samples[5].fdm.attitude.yaw_deg, 360.0), 0.0, 1e-9);
    EXPECT_NEAR(samples[5].fdm.attitude.pitch_deg, 5.0, 1e-9);
    EXPECT_NEAR(samples[5].fdm.attitude.roll_deg, -40.0, 1e-9);
}

TEST(SampleFlight, ATimeOfDayIsWrittenWhereTheLogHasADate) {
    Track track = circle();
    track.start_utc_s = 1566720131;
    const auto samples = sample_flight(track, {.rate_hz = 1.0});
    EXPECT_EQ(samples[7].fdm.cur_time, 1566720138U);
    EXPECT_EQ(sample_flight(circle(), {.rate_hz = 1.0})[7].fdm.cur_time, 0U);
}

}  // namespace
}  // namespace eyepoint::tools
