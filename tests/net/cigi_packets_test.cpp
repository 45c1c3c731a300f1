// The hex lines were made by Boeing's CIGI Class Library 3.3.3, little-endian, each field with a value of its
// own.
#include "net/wire/cigi_packets.hpp"

#include <functional>
#include <limits>

#include <gtest/gtest.h>

#include "tests/net/wire_bytes.hpp"

namespace eyepoint::net::wire {
namespace {

using testing::Bytes;
using testing::operator+;
using testing::ExactCopy;
using testing::from_hex;

const Bytes kIgControl = from_hex("011803053d00008000000000040302010000000000000000");
const Bytes kEntityControl = from_hex(
    "023002014919c80004030605000020410000a0410000f041000000000000444000000000000049400000000000004e40");
const Bytes kViewControl = from_hex("10200201033505040000803f0000004000004040000080400000a0400000c040");
const Bytes kViewDefinition = from_hex("1520020103adbb000000803f00409c460000f0c10000f8410000b0410000b8c1");
const Bytes kStartOfFrame = from_hex("651803fb07350080000000000d0c0b0a0000000000000000");

TEST(CigiPackets, IgControl) {
    const auto control = decode_ig_control(kIgControl);
    ASSERT_TRUE(control.has_value());
    EXPECT_EQ(control->dialect, (CigiDialect{ByteOrder::Little, false}));
    EXPECT_EQ(control->database, 5);
    EXPECT_EQ(control->mode, 1);
    EXPECT_TRUE(control->timestamp_valid);
    EXPECT_EQ(control->host_frame, 0U);
    EXPECT_EQ(control->timestamp_10us, 0x01020304U);
}

TEST(CigiPackets, IgControlOfSixteenBytesIsThatOf30And31) {
    const auto control =
        decode_ig_control(testing::ig_control({.size = 16, .host_frame = 77}, ByteOrder::Big));
    ASSERT_TRUE(control.has_value());
    EXPECT_EQ(control->dialect, (CigiDialect{ByteOrder::Big, true}));
    EXPECT_EQ(control->host_frame, 77U);
    EXPECT_EQ(control->last_ig_frame, 0U);
}

TEST(CigiPackets, IgControlLargerThanKnownIsTaken) {
    EXPECT_TRUE(decode_ig_control(testing::ig_control({.size = 32})).has_value());
}

TEST(CigiPackets, EntityControlClampedAndNamed) {
    Bytes at_top_level = kEntityControl;
    const auto control = decode_entity_control(at_top_level, ByteOrder::Little);
    ASSERT_TRUE(control.has_value());
    EXPECT_EQ(control->entity_id, 0x0102);
    EXPECT_EQ(control->state, CigiEntityControl::State::Active);
    ASSERT_TRUE(control->placed.has_value());
    EXPECT_EQ(control->placed->latitude_deg, 40.0);
    EXPECT_EQ(control->placed->longitude_deg, 50.0);
    EXPECT_EQ(control->placed->altitude_m, 60.0);
    EXPECT_EQ(control->placed->attitude.roll_deg, 10.0);
    EXPECT_EQ(control->placed->attitude.pitch_deg, 20.0);
    EXPECT_EQ(control->placed->attitude.yaw_deg, 30.0);
    EXPECT_TRUE(control->placed->above_ground);
}

TEST(CigiPackets, ViewControlKeepsToItsEnables) {
    // Enabled: x, z, pitch, yaw.
    const auto control = decode_view_control(kViewControl, ByteOrder::Little);
    ASSERT_TRUE(control.has_value());
    EXPECT_EQ(control->view_id, 0x0102);
    EXPECT_EQ(control->group_id, 3);
    EXPECT_EQ(control->entity_id, 0x0405);
    EXPECT_EQ(control->offset_m[0], 1.0);
    EXPECT_FALSE(control->offset_m[1].has_value());
    EXPECT_EQ(control->offset_m[2], 3.0);
    EXPECT_FALSE(control->roll_deg.has_value());
    EXPECT_EQ(control->pitch_deg, 5.0);
    EXPECT_EQ(control->yaw_deg, 6.0);
}

TEST(CigiPackets, ViewDefinitionKeepsToItsEnables) {
    // Enabled: near, left, right, bottom.
    const auto definition = decode_view_definition(kViewDefinition, ByteOrder::Little);
    ASSERT_TRUE(definition.has_value());
    EXPECT_EQ(definition->view_id, 0x0102);
    EXPECT_EQ(definition->near_m, 1.0);
    EXPECT_FALSE(definition->far_m.has_value());
    EXPECT_EQ(definition->left_deg, -30.0);
    EXPECT_EQ(definition->right_deg, 31.0);
    EXPECT_FALSE(definition->top_deg.has_value());
    EXPECT_EQ(definition->bottom_deg, -23.0);
}

TEST(CigiPackets, StartOfFrameIsWrittenAsTheClassLibraryWritesIt) {
    const CigiStartOfFrame start{-5, 7, 1, true, 0, 0x0a0b0c0d, 0};
    EXPECT_EQ(encode_start_of_frame(start, {ByteOrder::Little, false}), kStartOfFrame);
    EXPECT_EQ(decode_start_of_frame(kStartOfFrame), start);
}

TEST(CigiPackets, StartOfFrameComesBackInEveryDialect) {
    CigiStartOfFrame start{3, 0, 2, true, 0x01020304, 0x05060708, 0x090a0b0c};
    for (const ByteOrder order : {ByteOrder::Big, ByteOrder::Little}) {
        EXPECT_EQ(decode_start_of_frame(encode_start_of_frame(start, {order, false})), start);
        const auto short_layout = encode_start_of_frame(start, {order, true});
        EXPECT_EQ(short_layout.size(), 16U);
        CigiStartOfFrame without_host_frame = start;
        without_host_frame.last_host_frame = 0;
        EXPECT_EQ(decode_start_of_frame(short_layout), without_host_frame);
    }
}

TEST(CigiPackets, BigEndianSaysTheSame) {
    const testing::EntityFields entity{7, 1, 10, 20, 30, 40, 50, 60};
    const auto little = decode_entity_control(testing::entity_control(entity), ByteOrder::Little);
    const auto big = decode_entity_control(testing::entity_control(entity, ByteOrder::Big), ByteOrder::Big);
    ASSERT_TRUE(little && big);
    EXPECT_EQ(little->entity_id, big->entity_id);
    EXPECT_EQ(little->placed->latitude_deg, big->placed->latitude_deg);
    EXPECT_EQ(little->placed->attitude.yaw_deg, big->placed->attitude.yaw_deg);
    const testing::ViewFields view{9, 0, 0x3f, 4, {1, 2, -3, 4, 5, -6}};
    const auto big_view = decode_view_control(testing::view_control(view, ByteOrder::Big), ByteOrder::Big);
    ASSERT_TRUE(big_view.has_value());
    EXPECT_EQ(big_view->entity_id, 4);
    EXPECT_EQ(big_view->offset_m[2], -3.0);
    EXPECT_EQ(big_view->yaw_deg, 354.0);
}

TEST(CigiPackets, EveryTruncationIsRefused) {
    using Decode = std::function<bool(std::span<const std::byte>)>;
    const std::pair<Bytes, Decode> packets[] = {
        {kIgControl, [](auto bytes) { return decode_ig_control(bytes).has_value(); }},
        {kEntityControl,
         [](auto bytes) { return decode_entity_control(bytes, ByteOrder::Little).has_value(); }},
        {kViewControl, [](auto bytes) { return decode_view_control(bytes, ByteOrder::Little).has_value(); }},
        {kViewDefinition,
         [](auto bytes) { return decode_view_definition(bytes, ByteOrder::Little).has_value(); }},
        {kStartOfFrame, [](auto bytes) { return decode_start_of_frame(bytes).has_value(); }},
    };
    for (const auto& [whole, decode] : packets) {
        ASSERT_TRUE(decode(ExactCopy(whole).span()));
        for (std::size_t size = 0; size < whole.size(); ++size) {
            const ExactCopy cut(whole, size);
            // Sixteen bytes of IG Control and Start Of Frame are a whole packet of 3.0 and 3.1.
            const bool older =
                size >= kShortIgControlBytes && (whole == kIgControl || whole == kStartOfFrame);
            EXPECT_EQ(decode(cut.span()), older) << size << " of packet " << static_cast<int>(whole[0]);
        }
    }
}

TEST(CigiPackets, AWrongMagicNumberIsRefused) {
    Bytes bytes = kIgControl;
    bytes[7] = std::byte{0x40};
    const auto control = decode_ig_control(bytes);
    ASSERT_FALSE(control.has_value());
    EXPECT_EQ(control.error().reason, DropReason::WrongByteOrder);
}

struct BadEntity {
    const char* what;
    testing::EntityFields fields;
    DropReason reason;
};

TEST(CigiPackets, EntitiesThatAreNowhereAreRefused) {
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    const BadEntity cases[] = {
        {"latitude NaN", {.latitude = kNan}, DropReason::NotFinite},
        {"longitude NaN", {.longitude = kNan}, DropReason::NotFinite},
        {"altitude NaN", {.altitude = kNan}, DropReason::NotFinite},
        {"yaw infinite", {.yaw = kInfinity}, DropReason::NotFinite},
        {"roll infinite", {.roll = -kInfinity}, DropReason::NotFinite},
        {"latitude 90.1", {.latitude = 90.1}, DropReason::OutOfRange},
        {"longitude 361", {.longitude = 361}, DropReason::OutOfRange},
        {"altitude -2000", {.altitude = -2000}, DropReason::OutOfRange},
        {"altitude 1e9", {.altitude = 1e9}, DropReason::OutOfRange},
        {"pitch 91", {.pitch = 91}, DropReason::OutOfRange},
        {"state 3", {.flags = 3}, DropReason::OutOfRange},
    };
    for (const BadEntity& bad : cases) {
        const auto control = decode_entity_control(testing::entity_control(bad.fields), ByteOrder::Little);
        ASSERT_FALSE(control.has_value()) << bad.what;
        EXPECT_EQ(control.error().reason, bad.reason) << bad.what;
        EXPECT_FALSE(control.error().detail.empty());
    }
}

TEST(CigiPackets, YawOfAnyTurnAndLongitudeOf190AreBroughtIntoRange) {
    const auto control = decode_entity_control(
        testing::entity_control({.roll = 270, .yaw = -725, .longitude = 190}), ByteOrder::Little);
    ASSERT_TRUE(control.has_value());
    EXPECT_EQ(control->placed->attitude.yaw_deg, 355.0);
    EXPECT_EQ(control->placed->attitude.roll_deg, -90.0);
    EXPECT_EQ(control->placed->longitude_deg, -170.0);
}

TEST(CigiPackets, WhatIsNotEnabledMayBeAnything) {
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    const testing::ViewFields nothing{1, 0, 0, 0, {kNan, kNan, kNan, kNan, kNan, kNan}};
    EXPECT_TRUE(decode_view_control(testing::view_control(nothing), ByteOrder::Little).has_value());
    EXPECT_TRUE(decode_view_definition(testing::view_definition(nothing), ByteOrder::Little).has_value());
    const testing::ViewFields yaw{1, 0, 0x20, 0, {kNan, kNan, kNan, kNan, kNan, kNan}};
    EXPECT_FALSE(decode_view_control(testing::view_control(yaw), ByteOrder::Little).has_value());
    EXPECT_FALSE(decode_view_definition(testing::view_definition(yaw), ByteOrder::Little).has_value());
}

TEST(CigiPackets, ViewVolumesWithoutAPictureAreRefused) {
    const testing::ViewFields near_zero{1, 0, 0x01, 0, {0, 0, 0, 0, 0, 0}};
    const testing::ViewFields left_90{1, 0, 0x04, 0, {0, 0, -90, 0, 0, 0}};
    for (const auto& fields : {near_zero, left_90}) {
        const auto definition = decode_view_definition(testing::view_definition(fields), ByteOrder::Little);
        ASSERT_FALSE(definition.has_value());
        EXPECT_EQ(definition.error().reason, DropReason::OutOfRange);
    }
}

}  // namespace
}  // namespace eyepoint::net::wire
