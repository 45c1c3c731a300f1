#include "net/host_session.hpp"

#include <limits>

#include <gtest/gtest.h>

#include "net/wire/fgnetfdm.hpp"
#include "tests/net/wire_bytes.hpp"

namespace eyepoint::net {
namespace {

using testing::Bytes;
using testing::operator+;
using testing::entity_control;
using testing::ig_control;
using testing::rate_control;
using testing::view_control;
using testing::view_definition;
using wire::ByteOrder;

constexpr std::uint8_t kChild = 0x05, kDestroyed = 0x02, kInactive = 0x00;

std::uint64_t dropped(const HostSession& session, DropReason reason) {
    return session.counters().dropped[static_cast<std::size_t>(reason)];
}

Bytes fdm_at(double latitude_deg, double altitude_m) {
    wire::FgNetFdm fdm;
    fdm.latitude_deg = latitude_deg;
    fdm.longitude_deg = 8.0;
    fdm.altitude_m = altitude_m;
    const auto bytes = wire::encode_fgnetfdm24(fdm);
    return {bytes.begin(), bytes.end()};
}

TEST(HostSession, HasNoStateBeforeAHostHasSpoken) {
    HostSession session;
    EXPECT_EQ(session.state(), nullptr);
    session.receive(testing::from_hex("00112233445566778899"), {});
    EXPECT_EQ(session.state(), nullptr);
    EXPECT_EQ(session.counters().datagrams, 1U);
    EXPECT_EQ(session.counters().applied, 0U);
    EXPECT_EQ(session.counters().dropped_total(), 1U);
}

TEST(HostSession, FgNetFdmPlacesTheOwnship) {
    HostSession session;
    const Reception reception = session.receive(fdm_at(46.5, 2500.0), {123456789});
    EXPECT_TRUE(reception.applied);
    EXPECT_FALSE(reception.dropped.has_value());
    ASSERT_NE(session.state(), nullptr);
    EXPECT_EQ(session.state()->protocol, Protocol::FgNetFdm);
    EXPECT_EQ(session.state()->arrival.realtime_ns, 123456789);
    EXPECT_EQ(session.state()->commanded_mode, IgMode::Operate);
    EXPECT_NEAR(session.state()->ownship()->latitude_deg, 46.5, 1e-12);
    session.receive(fdm_at(46.6, 2500.0), {});
    EXPECT_EQ(session.state()->host_frame, 2U);
}

TEST(HostSession, FgNetFdmStatesItsVelocities) {
    wire::FgNetFdm fdm;
    fdm.velocity_ned_mps = {30.0, -40.0, 2.0};
    fdm.attitude_rate = {3.0, -1.0, 10.0};
    HostSession session;
    session.receive(wire::encode_fgnetfdm24(fdm), {});
    const auto& rates = session.state()->ownship()->rates;
    ASSERT_TRUE(rates.has_value());
    EXPECT_EQ(rates->axes, EntityRates::Axes::NorthEastDown);
    EXPECT_EQ(rates->turn, EntityRates::Turn::EulerAngles);
    EXPECT_NEAR(rates->velocity_mps[1], -40.0, 1e-4);
    EXPECT_NEAR(rates->turn_deg_s.roll_deg, 10.0, 1e-4);
    session.receive(fdm_at(46.5, 2500.0), {});
    EXPECT_FALSE(session.state()->ownship()->rates.has_value()) << "all zero: not filled in";
}

TEST(HostSession, CigiRatesStayInForceUntilOthersComeOrTheEntityGoes) {
    HostSession session;
    session.receive(ig_control({}) + rate_control({.v = {1, 2, 3, 4, 5, 6}}), {});
    EXPECT_TRUE(session.state()->entities.empty()) << "rates of an entity that is not there";
    session.receive(ig_control({.host_frame = 2}) + entity_control({}) +
                        rate_control({.flags = 2, .v = {70, 1, -2, 4, 5, 6}}),
                    {});
    session.receive(ig_control({.host_frame = 3}) + entity_control({.latitude = 46.1}), {});
    const auto& rates = session.state()->ownship()->rates;
    ASSERT_TRUE(rates.has_value());
    EXPECT_EQ(rates->axes, EntityRates::Axes::Body);
    EXPECT_EQ(rates->turn, EntityRates::Turn::AboutAxes);
    EXPECT_EQ(rates->velocity_mps, (std::array{70.0, 1.0, -2.0}));
    EXPECT_EQ(rates->turn_deg_s.roll_deg, 4.0);
    EXPECT_EQ(rates->turn_deg_s.yaw_deg, 6.0);
    session.receive(ig_control({.host_frame = 4}) + rate_control({.flags = 1, .v = {9, 9, 9, 9, 9, 9}}), {});
    EXPECT_EQ(session.state()->ownship()->rates->velocity_mps[0], 70.0) << "those of a part";
    session.receive(ig_control({.host_frame = 5}) + entity_control({.flags = kDestroyed}), {});
    session.receive(ig_control({.host_frame = 6}) + entity_control({}), {});
    EXPECT_FALSE(session.state()->ownship()->rates.has_value());
}

TEST(HostSession, ARateThatIsNotFiniteDropsItsPacketAlone) {
    HostSession session;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const auto reception =
        session.receive(ig_control({}) + entity_control({}) + rate_control({.v = {nan, 0, 0, 0, 0, 0}}), {});
    EXPECT_EQ(reception.dropped, DropReason::NotFinite);
    ASSERT_NE(session.state()->ownship(), nullptr);
    EXPECT_FALSE(session.state()->ownship()->rates.has_value());
}

TEST(HostSession, TheLastGoodEyeStays) {
    HostSession session;
    session.receive(fdm_at(46.5, 2500.0), {1});
    for (const Bytes& bad : {fdm_at(46.6, std::numeric_limits<double>::quiet_NaN()), fdm_at(46.6, 1e300),
                             fdm_at(46.6, 2500.0) + Bytes(1), Bytes(408), Bytes()}) {
        const Reception reception = session.receive(bad, {2});
        EXPECT_FALSE(reception.applied);
        ASSERT_TRUE(reception.dropped.has_value());
        EXPECT_FALSE(reception.detail.empty());
        EXPECT_NEAR(session.state()->ownship()->latitude_deg, 46.5, 1e-12);
        EXPECT_EQ(session.state()->arrival.realtime_ns, 1);
    }
    EXPECT_EQ(session.counters().dropped_total(), 5U);
    EXPECT_EQ(dropped(session, DropReason::NotFinite), 1U);
    EXPECT_EQ(dropped(session, DropReason::OutOfRange), 1U);
    EXPECT_EQ(dropped(session, DropReason::Long), 1U);
}

TEST(HostSession, CigiBuildsEntitiesAndViews) {
    for (const ByteOrder order : {ByteOrder::Little, ByteOrder::Big}) {
        HostSession session;
        const auto reception = session.receive(
            ig_control({.mode = 1, .database = 3, .host_frame = 9, .timestamp_10us = 250000}, order) +
                entity_control({0, 1, 1, 2, 90, 47.26, 11.35, 2500}, order) +
                entity_control({.id = 4, .flags = kInactive}, order) +
                view_definition({2, 0, 0x3d, 0, {0.25F, 0, -30, 31, 22, -23}}, order) +
                view_control({2, 0, 0x3f, 0, {1, 2, 3, 4, 5, 6}}, order),
            {7});
        ASSERT_TRUE(reception.applied);
        EXPECT_FALSE(reception.dropped.has_value()) << reception.detail;
        const HostState& state = *session.state();
        EXPECT_EQ(state.protocol, Protocol::Cigi);
        EXPECT_EQ(state.host_frame, 9U);
        EXPECT_EQ(state.requested_database, 3);
        EXPECT_DOUBLE_EQ(*state.host_time_s, 2.5);
        EXPECT_EQ(state.commanded_mode, IgMode::Operate);
        EXPECT_EQ(state.ownship()->latitude_deg, 47.26);
        EXPECT_EQ(state.ownship()->attitude.yaw_deg, 90.0);
        EXPECT_FALSE(state.entities.at(4).active);
        const ViewState& view = state.views.at(2);
        EXPECT_EQ(view.near_m, 0.25);
        EXPECT_EQ(view.left_deg, -30.0);
        EXPECT_EQ(view.right_deg, 31.0);
        EXPECT_EQ(view.top_deg, 22.0);
        EXPECT_EQ(view.bottom_deg, -23.0);
        EXPECT_EQ(view.offset_m, (std::array<double, 3>{1, 2, 3}));
        EXPECT_EQ(view.attitude.roll_deg, 4.0);
        EXPECT_EQ(view.attitude.yaw_deg, 6.0);
    }
}

TEST(HostSession, WhatAViewPacketDoesNotEnableStays) {
    HostSession session;
    session.receive(ig_control({}) + view_control({1, 0, 0x3f, 5, {1, 2, 3, 4, 5, 6}}) +
                        view_definition({1, 0, 0x3c, 0, {0, 0, -30, 30, 20, -20}}),
                    {});
    session.receive(ig_control({.host_frame = 2}) + view_control({1, 0, 0x02, 5, {9, 9, 9, 9, 9, 9}}) +
                        view_definition({1, 0, 0x08, 0, {9, 9, 9, 45, 9, 9}}),
                    {});
    const ViewState& view = session.state()->views.at(1);
    EXPECT_EQ(view.offset_m, (std::array<double, 3>{1, 9, 3}));
    EXPECT_EQ(view.attitude.pitch_deg, 5.0);
    EXPECT_EQ(view.left_deg, -30.0);
    EXPECT_EQ(view.right_deg, 45.0);
    EXPECT_FALSE(view.near_m.has_value());
}

TEST(HostSession, AViewDefinitionThatCrossesItsEdgesIsDropped) {
    HostSession session;
    session.receive(ig_control({}) + view_definition({1, 0, 0x3c, 0, {0, 0, -30, 30, 20, -20}}), {});
    const auto reception = session.receive(
        ig_control({.host_frame = 2}) + view_definition({1, 0, 0x08, 0, {0, 0, 0, -40, 0, 0}}), {});
    EXPECT_TRUE(reception.applied);
    EXPECT_EQ(reception.dropped, DropReason::OutOfRange);
    EXPECT_EQ(session.state()->views.at(1).right_deg, 30.0);
}

TEST(HostSession, ViewControlOfAGroupIsPassedOver) {
    HostSession session;
    session.receive(ig_control({}) + view_control({1, 3, 0x3f, 0, {1, 2, 3, 4, 5, 6}}), {});
    EXPECT_TRUE(session.state()->views.empty());
    EXPECT_EQ(session.counters().dropped_total(), 0U);
}

TEST(HostSession, DestroyedAndAttachedEntitiesLeave) {
    HostSession session;
    session.receive(
        ig_control({}) + entity_control({.id = 1}) + entity_control({.id = 2}) + entity_control({.id = 3}),
        {});
    // Offsets of a child, and whatever a destroyed one holds, are no place on the Earth and are not looked
    // at.
    const auto reception = session.receive(
        ig_control({.host_frame = 2}) + entity_control({.id = 1, .flags = kDestroyed, .latitude = 1e9}) +
            entity_control({.id = 2, .flags = kChild, .latitude = -500, .altitude = -9999}),
        {});
    EXPECT_FALSE(reception.dropped.has_value());
    EXPECT_EQ(session.state()->entities.size(), 1U);
    EXPECT_TRUE(session.state()->entities.contains(3));
}

TEST(HostSession, OneBadPacketDropsOnlyItself) {
    HostSession session;
    session.receive(ig_control({}) + entity_control({.latitude = 46.0}), {});
    const auto reception =
        session.receive(ig_control({.host_frame = 2}) + entity_control({.latitude = 91.0}) +
                            entity_control({.id = 8, .latitude = 47.0}),
                        {});
    EXPECT_TRUE(reception.applied);
    EXPECT_EQ(reception.dropped, DropReason::OutOfRange);
    EXPECT_EQ(session.state()->ownship()->latitude_deg, 46.0);
    EXPECT_EQ(session.state()->entities.at(8).latitude_deg, 47.0);
}

TEST(HostSession, UnknownPacketsAreWalkedOver) {
    Bytes unknown(24, std::byte{0xff});
    unknown[0] = std::byte{200};
    unknown[1] = std::byte{24};
    HostSession session;
    const auto reception = session.receive(ig_control({}) + unknown + entity_control({}), {});
    EXPECT_FALSE(reception.dropped.has_value());
    EXPECT_NE(session.state()->ownship(), nullptr);
}

TEST(HostSession, AnEntityControlLongerThanKnownIsTaken) {
    Bytes longer = entity_control({}) + Bytes(8, std::byte{0x7f});
    longer[1] = std::byte{56};
    HostSession session;
    session.receive(ig_control({}) + longer, {});
    EXPECT_EQ(session.state()->ownship()->altitude_m, 3000.0);
}

TEST(HostSession, APacketSizeThatLiesEndsTheWalkAndKeepsWhatCameBefore) {
    for (const unsigned size : {0U, 1U, 255U}) {
        Bytes lying = entity_control({.id = 9});
        lying[1] = static_cast<std::byte>(size);
        HostSession session;
        const auto reception = session.receive(ig_control({}) + entity_control({}) + lying, {});
        EXPECT_TRUE(reception.applied);
        EXPECT_EQ(reception.dropped, DropReason::BadPacketSize) << size;
        EXPECT_EQ(session.state()->entities.size(), 1U);
    }
}

TEST(HostSession, ASecondIgControlIsCountedAndNotUsed) {
    HostSession session;
    const auto reception =
        session.receive(ig_control({.host_frame = 5}) + ig_control({.mode = 0, .host_frame = 99}), {});
    EXPECT_EQ(reception.dropped, DropReason::MisplacedIgControl);
    EXPECT_EQ(session.state()->host_frame, 5U);
    EXPECT_EQ(session.state()->commanded_mode, IgMode::Operate);
}

TEST(HostSession, AStaleMessageChangesNothing) {
    HostSession session;
    session.receive(ig_control({.host_frame = 10}) + entity_control({.latitude = 46.0}), {});
    const auto reception =
        session.receive(ig_control({.host_frame = 9}) + entity_control({.latitude = 45.0}), {});
    EXPECT_FALSE(reception.applied);
    EXPECT_EQ(reception.dropped, DropReason::StaleFrame);
    EXPECT_EQ(session.state()->ownship()->latitude_deg, 46.0);
}

TEST(HostSession, TheChangeIntoStandbyResets) {
    HostSession session;
    session.receive(ig_control({.mode = 1}) + entity_control({}) + view_control({}), {});
    session.receive(ig_control({.mode = 0, .host_frame = 2}), {});
    EXPECT_TRUE(session.state()->entities.empty());
    EXPECT_TRUE(session.state()->views.empty());
    EXPECT_EQ(session.state()->commanded_mode, IgMode::Standby);
    // Repeating it does not wipe what the host prepares in standby.
    session.receive(ig_control({.mode = 0, .host_frame = 3}) + entity_control({}), {});
    session.receive(ig_control({.mode = 0, .host_frame = 4}), {});
    EXPECT_EQ(session.state()->entities.size(), 1U);
}

TEST(HostSession, ModesAndDatabasesThatCannotBeCommandedAreCounted) {
    HostSession session;
    session.receive(ig_control({.mode = 2, .database = 4}), {});
    EXPECT_EQ(session.state()->commanded_mode, IgMode::Debug);
    session.receive(ig_control({.mode = 3, .database = 0, .host_frame = 2}), {});
    session.receive(ig_control({.mode = 2, .database = -4, .host_frame = 3}), {});
    EXPECT_EQ(session.state()->commanded_mode, IgMode::Debug);
    EXPECT_EQ(session.state()->requested_database, 4);
    EXPECT_EQ(dropped(session, DropReason::OutOfRange), 2U);
}

TEST(HostSession, TheHostClockGoesOnThroughItsWrap) {
    HostSession session;
    session.receive(ig_control({.host_frame = 1, .timestamp_10us = 0xffffff00U}), {});
    const double before = *session.state()->host_time_s;
    session.receive(ig_control({.host_frame = 2, .timestamp_10us = 0x100U}), {});
    EXPECT_NEAR(*session.state()->host_time_s - before, 512e-5, 1e-9);
}

TEST(HostSession, StartOfFrameSpeaksTheHostsDialect) {
    HostSession session;
    const IgStatus status{17, IgMode::Operate, 3, 0, 1000};
    EXPECT_EQ(session.start_of_frame(status).size(), 24U);
    EXPECT_EQ(session.start_of_frame(status)[7], std::byte{0x80});  // little-endian before a host has spoken
    session.receive(ig_control({.host_frame = 42}, ByteOrder::Big), {});
    auto start = wire::decode_start_of_frame(session.start_of_frame(status));
    ASSERT_TRUE(start.has_value());
    EXPECT_EQ(start->ig_frame, 17U);
    EXPECT_EQ(start->last_host_frame, 42U);
    EXPECT_EQ(start->database, 3);
    EXPECT_EQ(session.start_of_frame(status)[6], std::byte{0x80});
    session.receive(ig_control({.size = 16, .host_frame = 43}), {});
    EXPECT_EQ(session.start_of_frame(status).size(), 16U);
}

TEST(HostSession, AHostOfTheOtherProtocolBeginsAfresh) {
    HostSession session;
    session.receive(ig_control({.host_frame = 900}) + entity_control({.id = 6}) + view_control({}), {});
    session.receive(fdm_at(46.5, 2500.0), {});
    EXPECT_EQ(session.state()->protocol, Protocol::FgNetFdm);
    EXPECT_EQ(session.state()->entities.size(), 1U);
    EXPECT_TRUE(session.state()->views.empty());
    EXPECT_TRUE(session.receive(ig_control({.host_frame = 1}), {}).applied);
    EXPECT_EQ(session.state()->protocol, Protocol::Cigi);
}

TEST(HostSession, EveryTruncationOfAMessageKeepsItsWholePackets) {
    const Bytes whole = ig_control({}) + entity_control({.id = 1}) + view_control({.view = 3}) +
                        view_definition({.view = 4, .enables = 0});
    for (std::size_t size = 0; size <= whole.size(); ++size) {
        HostSession session;
        const testing::ExactCopy cut(whole, size);
        const auto reception = session.receive(cut.span(), {});
        EXPECT_EQ(reception.applied, size >= 24) << size;
        const bool at_boundary = size == 24 || size == 72 || size == 104 || size == 136;
        EXPECT_EQ(reception.dropped.has_value(), !at_boundary) << size;
        if (size < 24) {
            EXPECT_EQ(reception.dropped, DropReason::Short) << size;
            continue;
        }
        EXPECT_EQ(session.state()->entities.size(), size >= 72 ? 1U : 0U) << size;
        EXPECT_EQ(session.state()->views.size(), (size >= 104 ? 1U : 0U) + (size >= 136 ? 1U : 0U)) << size;
    }
}

}  // namespace
}  // namespace eyepoint::net
