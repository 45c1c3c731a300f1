#include "net/wire/byte_order.hpp"

#include <gtest/gtest.h>

#include "tests/net/wire_bytes.hpp"

namespace eyepoint::net::wire {
namespace {

using testing::from_hex;

TEST(ByteReader, ReadsBothOrders) {
    const auto bytes = from_hex("0102030405060708");
    const ByteReader big(bytes, ByteOrder::Big), little(bytes, ByteOrder::Little);
    EXPECT_EQ(big.u16(0), 0x0102);
    EXPECT_EQ(little.u16(0), 0x0201);
    EXPECT_EQ(big.u32(2), 0x03040506U);
    EXPECT_EQ(little.u32(2), 0x06050403U);
    // 1.0 in IEEE 754.
    EXPECT_EQ(ByteReader(from_hex("3f800000"), ByteOrder::Big).f32(0), 1.0F);
    EXPECT_EQ(ByteReader(from_hex("000000000000f03f"), ByteOrder::Little).f64(0), 1.0);
    EXPECT_EQ(ByteReader(from_hex("fffffffe"), ByteOrder::Big).i32(0), -2);
}

TEST(ByteReader, TakesBitsFromTheLeastSignificantOn) {
    const auto bytes = from_hex("b5");  // 1011 0101
    const ByteReader reader(bytes, ByteOrder::Big);
    EXPECT_EQ(reader.bits(0, 0, 2), 1U);
    EXPECT_EQ(reader.bits(0, 2, 1), 1U);
    EXPECT_EQ(reader.bits(0, 4, 4), 11U);
}

TEST(ByteReader, GivesZeroOutside) {
    const testing::ExactCopy bytes(from_hex("ffffff"));
    const ByteReader reader(bytes.span(), ByteOrder::Little);
    EXPECT_EQ(reader.u32(0), 0U);
    EXPECT_EQ(reader.u16(2), 0U);
    EXPECT_EQ(reader.u8(3), 0U);
    EXPECT_EQ(reader.f64(static_cast<std::size_t>(-1)), 0.0);
}

TEST(ByteWriter, WritesWhatTheReaderReads) {
    for (const ByteOrder order : {ByteOrder::Big, ByteOrder::Little}) {
        testing::Bytes bytes(16);
        const ByteWriter writer(bytes, order);
        writer.f64(0, -46.5);
        writer.u16(8, 0xabcd);
        writer.f32(12, 8.25F);
        writer.u32(13, 1);  // does not fit: nothing is written
        const ByteReader reader(bytes, order);
        EXPECT_EQ(reader.f64(0), -46.5);
        EXPECT_EQ(reader.u16(8), 0xabcd);
        EXPECT_EQ(reader.f32(12), 8.25F);
    }
}

}  // namespace
}  // namespace eyepoint::net::wire
