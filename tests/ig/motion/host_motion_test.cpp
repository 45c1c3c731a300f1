#include "ig/motion/host_motion.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace eyepoint::ig {
namespace {

using net::EntityRates;
using net::EntityState;

constexpr std::int64_t kMs = 1'000'000;
constexpr double kMetresPerDegree = 111'194.0;  // of latitude near 46 N, within 0.1%

/// Due north at a speed; the rates it states are those, times a factor.
EntityState north_at(double metres, double stated_mps) {
    EntityState entity{.latitude_deg = 46.0 + metres / kMetresPerDegree,
                       .longitude_deg = 8.0,
                       .altitude_m = 3000.0,
                       .attitude = {}};
    if (stated_mps != 0.0) entity.rates = EntityRates{.velocity_mps = {stated_mps, 0.0, 0.0}};
    return entity;
}

double north_m(const EntityState& entity) { return (entity.latitude_deg - 46.0) * kMetresPerDegree; }

/// What is drawn `ahead_ms` after the last packet of a flight at 60 m/s, a packet every `every_ms`.
HostMotion::MovedOn flown(HostMotion& motion, int packets, int every_ms, double stated_mps, int ahead_ms) {
    for (int i = 0; i < packets; ++i)
        EXPECT_FALSE(motion.observe(north_at(0.06 * i * every_ms, stated_mps), {i * every_ms * kMs, {}}));
    return *motion.at(((packets - 1) * every_ms + ahead_ms) * kMs);
}

TEST(HostMotion, KnowsNothingBeforeTheFirstPacket) { EXPECT_FALSE(HostMotion().at(0).has_value()); }

TEST(HostMotion, OnePacketIsDrawnWhereItIs) {
    HostMotion motion;
    const auto moved = flown(motion, 1, 33, 60.0, 50);
    EXPECT_EQ(moved.by_s, 0.0);
    EXPECT_EQ(moved.entity.latitude_deg, 46.0);
}

TEST(HostMotion, AtThePacketsOwnTimeItIsThePacketBitForBit) {
    HostMotion motion;
    const auto moved = flown(motion, 5, 33, 60.0, 0);
    EXPECT_EQ(moved.by_s, 0.0);
    EXPECT_EQ(moved.entity.latitude_deg, north_at(0.06 * 4 * 33, 0.0).latitude_deg);
    EXPECT_EQ(motion.at(0)->by_s, 0.0) << "a time before the packet";
}

TEST(HostMotion, MovesOnByStatedVelocitiesAndByDifferences) {
    for (const double stated_mps : {60.0, 0.0}) {
        HostMotion motion;
        const auto moved = flown(motion, 5, 100, stated_mps, 50);
        EXPECT_NEAR(north_m(moved.entity), 24.0 + 3.0, 0.01) << stated_mps;
        EXPECT_DOUBLE_EQ(moved.by_s, 0.05);
    }
}

TEST(HostMotion, ASilentHostsVehicleStandsAfterTheLongestTime) {
    HostMotion motion;
    const auto limit = flown(motion, 5, 100, 60.0, 200);
    const auto later = *motion.at(60'000 * kMs);
    EXPECT_NEAR(north_m(later.entity), 24.0 + 12.0, 0.02);
    EXPECT_EQ(later.entity.latitude_deg, limit.entity.latitude_deg);
    EXPECT_EQ(later.by_s, HostMotion::kLongestS);
}

TEST(HostMotion, VelocitiesThatTheWayBeliesAreNotBelieved) {
    HostMotion motion;  // states feet where metres are meant
    const auto moved = flown(motion, 30, 33, 60.0 / 0.3048, 100);
    EXPECT_NEAR(north_m(moved.entity) - 0.06 * 29 * 33, 6.0, 0.1);
}

TEST(HostMotion, APausedHostThatKeepsItsVelocityIsDrawnWhereItStands) {
    HostMotion motion;
    flown(motion, 5, 33, 60.0, 0);
    for (int i = 5; i < 15; ++i) motion.observe(north_at(0.06 * 4 * 33, 60.0), {i * 33 * kMs, {}});
    const auto moved = *motion.at((14 * 33 + 30) * kMs);
    EXPECT_EQ(moved.by_s, 0.0);
    EXPECT_EQ(moved.entity.latitude_deg, north_at(0.06 * 4 * 33, 0.0).latitude_deg);
}

TEST(HostMotion, ARepeatedPacketOfAMovingHostDoesNotStopIt) {
    HostMotion motion;
    flown(motion, 5, 33, 60.0, 0);
    motion.observe(north_at(0.06 * 4 * 33, 60.0), {(4 * 33 + 10) * kMs, {}});
    EXPECT_NEAR(north_m(motion.at((4 * 33 + 20) * kMs)->entity), 0.06 * (4 * 33 + 20), 0.01);
}

TEST(HostMotion, AJumpIsDrawnAtOnceAndNotMovedOn) {
    for (const double stated_mps : {60.0, 0.0}) {
        HostMotion motion;
        flown(motion, 5, 33, stated_mps, 0);
        EXPECT_TRUE(motion.observe(north_at(500.0, stated_mps), {5 * 33 * kMs, {}}));
        const auto moved = *motion.at((5 * 33 + 30) * kMs);
        EXPECT_EQ(moved.by_s, 0.0);
        EXPECT_EQ(moved.entity.latitude_deg, north_at(500.0, 0.0).latitude_deg);
        EXPECT_FALSE(motion.observe(north_at(500.0 + 0.06 * 33, stated_mps), {6 * 33 * kMs, {}}));
        EXPECT_FALSE(motion.observe(north_at(500.0 + 0.06 * 66, stated_mps), {7 * 33 * kMs, {}}));
        EXPECT_NEAR(north_m(motion.at((7 * 33 + 30) * kMs)->entity), 500.0 + 0.06 * 96, 0.05)
            << "it goes on from the packets after it";
    }
}

TEST(HostMotion, AVehicleThatStoodAndIsPutElsewhereHasJumped) {
    HostMotion motion;
    for (int i = 0; i < 20; ++i) motion.observe(north_at(0.0, 0.0), {i * 33 * kMs, {}});
    EXPECT_TRUE(motion.observe(north_at(80.0, 0.0), {20 * 33 * kMs, {}}));
    EXPECT_EQ(motion.at((20 * 33 + 100) * kMs)->by_s, 0.0);
}

TEST(HostMotion, OneDifferenceAloneIsNoVelocity) {
    HostMotion motion;
    EXPECT_EQ(flown(motion, 2, 33, 0.0, 50).by_s, 0.0);
    EXPECT_GT(flown(motion, 3, 33, 0.0, 50).by_s, 0.0);
}

TEST(HostMotion, NothingMovesFasterThanASatellite) {
    HostMotion motion;
    motion.observe(north_at(0.0, 0.0), {0, {}});
    EXPECT_TRUE(motion.observe(north_at(400'000.0, 0.0), {33 * kMs, {}}));
    EXPECT_EQ(motion.at(50 * kMs)->by_s, 0.0);
}

TEST(HostMotion, PacketsThatComeInBunchesAreNoJumps) {
    HostMotion motion;
    int jumps = 0;
    for (int i = 0; i < 40; ++i) {
        const std::int64_t bunched_ms = i / 2 * 66 + i % 2;  // sent every 33 ms, they come in pairs
        jumps += motion.observe(north_at(0.06 * i * 33, 60.0), {bunched_ms * kMs, {}}) ? 1 : 0;
    }
    EXPECT_EQ(jumps, 0);
    EXPECT_NEAR(north_m(motion.at((19 * 66 + 1 + 50) * kMs)->entity), 0.06 * (39 * 33 + 50), 0.05);
}

TEST(HostMotion, AHostAtOneHertzIsMovedOnToo) {
    HostMotion motion;
    const auto moved = flown(motion, 4, 1000, 60.0, 100);
    EXPECT_NEAR(north_m(moved.entity), 0.06 * 3100, 0.2);
}

TEST(HostMotion, AfterALongSilenceItBeginsAnew) {
    HostMotion motion;
    flown(motion, 5, 33, 60.0, 0);
    EXPECT_FALSE(motion.observe(north_at(20'000.0, 60.0), {10'000 * kMs, {}}));
    EXPECT_EQ(motion.at(10'050 * kMs)->by_s, 0.0);
}

TEST(HostMotion, TheHostsOwnClockEvensOutTheArrivals) {
    HostMotion motion;
    for (int i = 0; i < 10; ++i) {
        const int late_ms = i == 9 ? 12 : 0;
        motion.observe(north_at(0.06 * i * 33, 0.0), {(i * 33 + late_ms) * kMs, 500.0 + 0.033 * i});
    }
    const auto moved = *motion.at((9 * 33 + 12 + 100) * kMs);
    EXPECT_NEAR(north_m(moved.entity), 0.06 * (9 * 33 + 100), 0.01);
}

TEST(HostMotion, AHostClockOfAnotherUnitIsNotBelieved) {
    HostMotion motion;
    for (int i = 0; i < 10; ++i) motion.observe(north_at(0.06 * i * 33, 0.0), {i * 33 * kMs, 0.0033 * i});
    EXPECT_NEAR(north_m(motion.at((9 * 33 + 100) * kMs)->entity), 0.06 * (9 * 33 + 100), 0.01);
}

TEST(HostMotion, TurnsAsTheHostSays) {
    HostMotion motion;
    for (int i = 0; i < 10; ++i) {
        EntityState entity = north_at(0.06 * i * 33, 60.0);
        entity.attitude.yaw_deg = 0.033 * i * 20.0;
        entity.rates->turn_deg_s.yaw_deg = 20.0;
        motion.observe(entity, {i * 33 * kMs, {}});
    }
    EXPECT_NEAR(motion.at((9 * 33 + 100) * kMs)->entity.attitude.yaw_deg, 20.0 * (0.297 + 0.1), 0.01);
}

/// Whatever a host sends, the entity that is drawn is finite, in range, and not further from the newest
/// packet than the fastest vehicle goes in the longest time.
RC_GTEST_PROP(HostMotion, NeverLeavesTheEarth, ()) {
    const auto number = [](double low, double high) {
        return low + (high - low) * *rc::gen::inRange(0, 1001) / 1000.0;
    };
    const auto rate = [&] { return number(-1, 1) * std::pow(10.0, *rc::gen::inRange(0, 39)); };
    const double latitude = number(-90, 90), longitude = number(-180, 180);
    const double spread_deg = std::pow(10.0, -*rc::gen::inRange(0, 7));
    HostMotion motion;
    EntityState newest;
    std::int64_t now_ns = 0;
    for (int i = 0; i < 12; ++i) {
        newest = {.latitude_deg = std::clamp(latitude + number(-1, 1) * spread_deg, -90.0, 90.0),
                  .longitude_deg = std::remainder(longitude + number(-1, 1) * spread_deg, 360.0),
                  .altitude_m = number(-1000, 1e6),
                  .attitude = {number(0, 360), number(-90, 90), number(-180, 180)}};
        if (*rc::gen::arbitrary<bool>()) {
            newest.rates =
                EntityRates{.velocity_mps = {rate(), rate(), rate()}, .turn_deg_s = {rate(), rate(), rate()}};
        }
        now_ns += static_cast<std::int64_t>(std::pow(10.0, number(-1, 9.6)));
        motion.observe(newest, {now_ns, {}});
        const EntityState drawn =
            motion.at(now_ns + *rc::gen::inRange(-1'000'000'000, 1'000'000'000))->entity;
        RC_ASSERT(std::abs(drawn.latitude_deg) <= 90.0);
        RC_ASSERT(std::abs(drawn.longitude_deg) <= 180.0);
        RC_ASSERT(drawn.attitude.yaw_deg >= 0.0 && drawn.attitude.yaw_deg <= 360.0);
        RC_ASSERT(std::abs(drawn.attitude.pitch_deg) <= 90.0);
        RC_ASSERT(std::abs(drawn.attitude.roll_deg) <= 180.0);
        // Differences may be as fast as the fastest, and a jump's tolerance more.
        RC_ASSERT(glm::length(way_between(newest, drawn)) <=
                  1.5 * HostMotion::kFastestMps * HostMotion::kLongestS);
    }
}

TEST(HostMotion, ForgetsOnDemand) {
    HostMotion motion;
    flown(motion, 5, 33, 60.0, 0);
    motion.forget();
    EXPECT_FALSE(motion.at(0).has_value());
}

}  // namespace
}  // namespace eyepoint::ig
