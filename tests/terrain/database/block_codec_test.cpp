#include "terrain/database/block_codec.hpp"

#include <random>

#include <gtest/gtest.h>

#include "tests/terrain/database/small_database.hpp"

namespace eyepoint::terrain {
namespace {

TEST(BlockCodec, GivesBackHeightsWaterAndUndulationsExactly) {
    const BlockData block = rough_block({3, 5, 2});
    const auto decoded = decode_block(block.tile, encode_block(block, 1.0 / 16.0), 1.0 / 16.0);
    ASSERT_TRUE(decoded.has_value()) << decoded.error();
    EXPECT_EQ(decoded->tile, block.tile);
    EXPECT_EQ(decoded->heights_m, block.heights_m);
    EXPECT_EQ(decoded->water, block.water);
    EXPECT_EQ(decoded->undulation_m, block.undulation_m);
}

TEST(BlockCodec, RoundsHeightsToTheNearestStep) {
    BlockData block;
    block.heights_m.fill(100.3F);
    const auto decoded = decode_block(block.tile, encode_block(block, 0.25), 0.25);
    ASSERT_TRUE(decoded.has_value());
    EXPECT_EQ(decoded->height_m(7, 9), 100.25F);
}

TEST(BlockCodec, KeepsTheHighestAndTheLowestPlacesOfTheEarth) {
    BlockData block;
    for (std::size_t i = 0; i < block.heights_m.size(); ++i)
        block.heights_m[i] = i % 2 == 0 ? 8'848.0F : -11'000.0F;
    block.water.fill(1);
    const auto decoded = decode_block(block.tile, encode_block(block, 1.0 / 64.0), 1.0 / 64.0);
    ASSERT_TRUE(decoded.has_value());
    EXPECT_EQ(decoded->heights_m, block.heights_m);
    EXPECT_EQ(decoded->water, block.water);
}

TEST(BlockCodec, RefusesEveryTruncation) {
    const auto bytes = encode_block(rough_block({0, 0, 0}), 1.0 / 16.0);
    for (std::size_t size = 0; size < bytes.size(); ++size) {
        const std::vector<std::uint8_t> cut{bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size)};
        EXPECT_FALSE(decode_block({0, 0, 0}, cut, 1.0 / 16.0).has_value()) << size;
    }
}

// The checksum of the shard guards a block; without it the decoder must still not read beyond its bytes.
TEST(BlockCodec, SurvivesBytesChangedAnywhere) {
    const auto bytes = encode_block(rough_block({0, 0, 0}), 1.0 / 16.0);
    std::mt19937 random{7};
    for (int trial = 0; trial < 2'000; ++trial) {
        auto changed = bytes;
        for (int i = 0; i < 3; ++i) changed[random() % changed.size()] = static_cast<std::uint8_t>(random());
        (void)decode_block({0, 0, 0}, changed, 1.0 / 16.0);
    }
}

}  // namespace
}  // namespace eyepoint::terrain
