#include "tools/replay/track_motion.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace eyepoint::tools {
namespace {

constexpr double kStep_s = 1.0 / 30.0;
constexpr double kDegreesPerRadian = 180.0 / std::numbers::pi;

// A level turn to the right at constant speed: course grows evenly.
std::vector<Motion> right_turn(double speed_mps, double rate_deg_per_s, int samples) {
    std::vector<Motion> motions;
    for (int i = 0; i < samples; ++i) {
        const double course = rate_deg_per_s * i * kStep_s / kDegreesPerRadian;
        const double across = speed_mps * rate_deg_per_s / kDegreesPerRadian;
        motions.push_back({{speed_mps * std::cos(course), speed_mps * std::sin(course), 0.0},
                           {-across * std::sin(course), across * std::cos(course), 0.0}});
    }
    return motions;
}

TEST(CoordinatedAttitudes, ATurnIsBankedAsTheBookSays) {
    // 50 m/s at 3 degrees a second: tan(bank) = 50 * 0.05236 / 9.80665, so 14.94 degrees.
    for (const auto& attitude : coordinated_attitudes(right_turn(50.0, 3.0, 300), kStep_s)) {
        EXPECT_NEAR(attitude.roll_deg, 14.94, 0.01);
        EXPECT_NEAR(attitude.pitch_deg, 0.0, 1e-12);
    }
    for (const auto& attitude : coordinated_attitudes(right_turn(50.0, -3.0, 300), kStep_s)) {
        EXPECT_NEAR(attitude.roll_deg, -14.94, 0.01);
    }
}

TEST(CoordinatedAttitudes, YawFollowsTheCourseThroughNorth) {
    const auto attitudes = coordinated_attitudes(right_turn(50.0, -3.0, 300), kStep_s);
    for (std::size_t i = 0; i < attitudes.size(); ++i) {
        const double course = -3.0 * static_cast<double>(i) * kStep_s;
        EXPECT_NEAR(std::remainder(attitudes[i].yaw_deg - course, 360.0), 0.0, 1e-9);
        EXPECT_GE(attitudes[i].yaw_deg, 0.0);
        EXPECT_LT(attitudes[i].yaw_deg, 360.0);
    }
}

TEST(CoordinatedAttitudes, PitchIsTheFlightPathAngle) {
    const Motion climbing{{30.0, 40.0, -5.0}, {}};
    const auto attitude = coordinated_attitudes(std::vector{climbing}, kStep_s).front();
    EXPECT_NEAR(attitude.pitch_deg, std::atan(0.1) * kDegreesPerRadian, 1e-9);
    EXPECT_NEAR(attitude.yaw_deg, std::atan2(40.0, 30.0) * kDegreesPerRadian, 1e-9);
}

TEST(CoordinatedAttitudes, BankAndPitchAreLimited) {
    const Motion violent{{5.0, 0.0, -500.0}, {0.0, 900.0, 0.0}};
    const auto attitude = coordinated_attitudes(std::vector{violent}, kStep_s).front();
    EXPECT_EQ(attitude.roll_deg, kMostBankDeg);
    EXPECT_EQ(attitude.pitch_deg, kMostPitchDeg);
}

TEST(CoordinatedAttitudes, AVehicleAtRestKeepsItsHeading) {
    std::vector<Motion> motions{{{0.0, 20.0, 0.0}, {}}};
    for (int i = 0; i < 100; ++i) motions.push_back({{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}});
    EXPECT_NEAR(coordinated_attitudes(motions, kStep_s).back().yaw_deg, 90.0, 1e-9);
}

TEST(Smoothed, KeepsAConstantAndASlope) {
    std::vector<Vector3> line;
    for (int i = 0; i < 100; ++i) line.push_back({2.0, 3.0 * i, -1.0 * i});
    const auto after = smoothed(line, 10.0);
    ASSERT_EQ(after.size(), line.size());
    for (std::size_t i = 0; i < line.size(); ++i) {
        for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_NEAR(after[i][axis], line[i][axis], 1e-9);
    }
}

TEST(Smoothed, SpreadsAnImpulseByTheDeviationAskedFor) {
    std::vector<Vector3> impulse(401);
    impulse[200] = {1.0, 0.0, 0.0};
    const auto after = smoothed(impulse, 20.0);
    double sum = 0.0, variance = 0.0;
    for (int i = 0; i < 401; ++i) {
        const double weight = after[static_cast<std::size_t>(i)][0];
        sum += weight;
        variance += weight * (i - 200) * (i - 200);
    }
    EXPECT_NEAR(sum, 1.0, 1e-9);
    EXPECT_NEAR(std::sqrt(variance), 20.0, 0.5);
}

}  // namespace
}  // namespace eyepoint::tools
