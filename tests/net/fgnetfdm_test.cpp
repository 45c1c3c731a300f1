#include "net/wire/fgnetfdm.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/net/flights.hpp"
#include "tests/net/wire_bytes.hpp"

namespace eyepoint::net::wire {
namespace {

using testing::Bytes;
using testing::operator+;
using testing::ExactCopy;

constexpr double kRadian = 180.0 / std::numbers::pi;

Bytes first_of_sample_flight() {
    return testing::datagrams_to(testing::sample_flight(), 5560).front().payload;
}

Bytes with_f64(Bytes bytes, std::size_t offset, double value) {
    ByteWriter(bytes, ByteOrder::Big).f64(offset, value);
    return bytes;
}
Bytes with_f32(Bytes bytes, std::size_t offset, float value) {
    ByteWriter(bytes, ByteOrder::Big).f32(offset, value);
    return bytes;
}
DropReason reason_of(const Bytes& bytes) {
    const auto fdm = decode_fgnetfdm(bytes);
    EXPECT_FALSE(fdm.has_value());
    return fdm ? DropReason::Count : fdm.error().reason;
}

// Expected numbers: the same bytes unpacked with Python's struct module, format '>'.
TEST(FgNetFdm, DecodesAPacketOfJsbsim) {
    const auto fdm = decode_fgnetfdm(first_of_sample_flight());
    ASSERT_TRUE(fdm.has_value());
    EXPECT_NEAR(fdm->longitude_deg, 0.14200485420225564 * kRadian, 1e-12);
    EXPECT_NEAR(fdm->latitude_deg, 0.809874822381037 * kRadian, 1e-12);
    EXPECT_DOUBLE_EQ(fdm->altitude_m, 3043.81166711441);
    EXPECT_NEAR(fdm->above_ground_m, 3043.79443359375, 1e-9);
    EXPECT_NEAR(fdm->attitude.roll_deg, 0.002670642454177141 * kRadian, 1e-9);
    EXPECT_NEAR(fdm->attitude.pitch_deg, 0.03596332669258118 * kRadian, 1e-9);
    EXPECT_NEAR(fdm->attitude.yaw_deg, 0.8321160078048706 * kRadian, 1e-9);
    EXPECT_NEAR(fdm->attitude_rate.roll_deg, -0.001558459596708417 * kRadian, 1e-9);
    EXPECT_NEAR(fdm->velocity_ned_mps[0], 131.09030151367188 * 0.3048, 1e-6);
    EXPECT_NEAR(fdm->velocity_ned_mps[1], 143.95477294921875 * 0.3048, 1e-6);
    EXPECT_NEAR(fdm->velocity_ned_mps[2], -4.132795333862305 * 0.3048, 1e-6);
    EXPECT_EQ(fdm->cur_time, 19999U);
    EXPECT_EQ(fdm->warp_s, 0);
    EXPECT_EQ(fdm->visibility_m, 25000.0);
}

TEST(FgNetFdm, RefusesEveryTruncation) {
    const Bytes whole = first_of_sample_flight();
    for (std::size_t size = 0; size < whole.size(); ++size) {
        const ExactCopy cut(whole, size);
        const auto fdm = decode_fgnetfdm(cut.span());
        ASSERT_FALSE(fdm.has_value()) << size;
        EXPECT_EQ(fdm.error().reason, DropReason::Short) << size;
    }
}

TEST(FgNetFdm, RefusesExtraBytes) {
    EXPECT_EQ(reason_of(first_of_sample_flight() + Bytes(1)), DropReason::Long);
    EXPECT_EQ(reason_of(first_of_sample_flight() + Bytes(144)), DropReason::Long);
}

TEST(FgNetFdm, TakesVersion25In552Bytes) {
    Bytes bytes = first_of_sample_flight();
    bytes.resize(kFgNetFdm25Bytes);
    const ByteWriter writer(bytes, ByteOrder::Big);
    writer.u32(0, 25);
    writer.u32(500, 1566720131);
    writer.i32(504, -30000);
    writer.f32(508, 12000.0F);
    const auto fdm = decode_fgnetfdm(bytes);
    ASSERT_TRUE(fdm.has_value());
    EXPECT_DOUBLE_EQ(fdm->altitude_m, 3043.81166711441);
    EXPECT_EQ(fdm->visibility_m, 12000.0);
    EXPECT_EQ(fdm->utc_s(), 1566720131.0 - 30000.0);
    writer.u32(0, 24);
    EXPECT_EQ(reason_of(bytes), DropReason::Long);
}

TEST(FgNetFdm, NamesALittleEndianSender) {
    Bytes bytes(kFgNetFdm24Bytes);
    ByteWriter(bytes, ByteOrder::Little).u32(0, 24);
    const auto fdm = decode_fgnetfdm(bytes);
    ASSERT_FALSE(fdm.has_value());
    EXPECT_EQ(fdm.error().reason, DropReason::WrongByteOrder);
    EXPECT_NE(fdm.error().detail.find("little-endian"), std::string::npos);
}

TEST(FgNetFdm, NamesOtherVersions) {
    Bytes bytes(kFgNetFdm24Bytes);
    ByteWriter(bytes, ByteOrder::Big).u32(0, 8);
    const auto fdm = decode_fgnetfdm(bytes);
    ASSERT_FALSE(fdm.has_value());
    EXPECT_EQ(fdm.error().reason, DropReason::WrongVersion);
    EXPECT_NE(fdm.error().detail.find("version 8"), std::string::npos);
}

TEST(FgNetFdm, RefusesWhatIsNotFinite) {
    const Bytes good = first_of_sample_flight();
    for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
        for (const std::size_t offset : {8U, 16U, 24U})
            EXPECT_EQ(reason_of(with_f64(good, offset, bad)), DropReason::NotFinite);
        for (const std::size_t offset : {36U, 40U, 44U}) {
            EXPECT_EQ(reason_of(with_f32(good, offset, static_cast<float>(bad))), DropReason::NotFinite);
        }
    }
}

TEST(FgNetFdm, RefusesWhatIsOutOfRange) {
    const Bytes good = first_of_sample_flight();
    EXPECT_EQ(reason_of(with_f64(good, 16, 46.4)), DropReason::OutOfRange);  // degrees sent as radians
    EXPECT_EQ(reason_of(with_f64(good, 16, -1.5708)), DropReason::OutOfRange);
    EXPECT_EQ(reason_of(with_f64(good, 8, 6.2832)), DropReason::OutOfRange);
    EXPECT_EQ(reason_of(with_f64(good, 24, -1001.0)), DropReason::OutOfRange);
    EXPECT_EQ(reason_of(with_f64(good, 24, 1.0e300)), DropReason::OutOfRange);
    EXPECT_EQ(reason_of(with_f32(good, 40, 1.6F)), DropReason::OutOfRange);
}

TEST(FgNetFdm, TakesThePolesAndTheZenith) {
    Bytes bytes = with_f64(first_of_sample_flight(), 16, std::numbers::pi / 2);
    bytes = with_f32(bytes, 40, std::numbers::pi_v<float> / 2);  // a little above pi/2
    const auto fdm = decode_fgnetfdm(bytes);
    ASSERT_TRUE(fdm.has_value());
    EXPECT_EQ(fdm->latitude_deg, 90.0);
    EXPECT_EQ(fdm->attitude.pitch_deg, 90.0);
}

TEST(FgNetFdm, BringsAnglesIntoTheirRanges) {
    Bytes bytes = with_f32(first_of_sample_flight(), 44, static_cast<float>(-5.0 / kRadian));
    bytes = with_f64(bytes, 8, 190.0 / kRadian);
    bytes = with_f32(bytes, 36, static_cast<float>(200.0 / kRadian));
    const auto fdm = decode_fgnetfdm(bytes);
    ASSERT_TRUE(fdm.has_value());
    EXPECT_NEAR(fdm->attitude.yaw_deg, 355.0, 1e-5);
    EXPECT_NEAR(fdm->longitude_deg, -170.0, 1e-9);
    EXPECT_NEAR(fdm->attitude.roll_deg, -160.0, 1e-4);
}

TEST(FgNetFdm, ReadsVelocitiesThatAreNotFiniteAsZero) {
    const auto fdm =
        decode_fgnetfdm(with_f32(first_of_sample_flight(), 76, std::numeric_limits<float>::quiet_NaN()));
    ASSERT_TRUE(fdm.has_value());
    EXPECT_EQ(fdm->velocity_ned_mps[0], 0.0);
}

TEST(FgNetFdm, BelievesOnlyATimeThatCanBeUtc) {
    FgNetFdm fdm;
    fdm.cur_time = 1234567890;  // JSBSim's constant
    EXPECT_FALSE(fdm.utc_s().has_value());
    fdm.cur_time = 20000;  // simulation time in milliseconds
    EXPECT_FALSE(fdm.utc_s().has_value());
    fdm.cur_time = 1566720131;
    fdm.warp_s = -30000;
    EXPECT_EQ(fdm.utc_s(), 1566690131.0);
}

TEST(FgNetFdm, EncodesWhatItDecodes) {
    const auto sent = decode_fgnetfdm(first_of_sample_flight());
    ASSERT_TRUE(sent.has_value());
    const auto again = decode_fgnetfdm(encode_fgnetfdm24(*sent));
    ASSERT_TRUE(again.has_value());
    EXPECT_NEAR(again->latitude_deg, sent->latitude_deg, 1e-13);
    EXPECT_NEAR(again->longitude_deg, sent->longitude_deg, 1e-13);
    EXPECT_EQ(again->altitude_m, sent->altitude_m);
    EXPECT_NEAR(again->attitude.yaw_deg, sent->attitude.yaw_deg, 1e-5);
    EXPECT_NEAR(again->attitude_rate.roll_deg, sent->attitude_rate.roll_deg, 1e-6);
    EXPECT_NEAR(again->velocity_ned_mps[2], sent->velocity_ned_mps[2], 1e-6);
    EXPECT_EQ(again->cur_time, sent->cur_time);
    EXPECT_EQ(again->visibility_m, sent->visibility_m);
}

}  // namespace
}  // namespace eyepoint::net::wire
