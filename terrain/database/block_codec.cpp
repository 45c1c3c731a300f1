#include "terrain/database/block_codec.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <zstd.h>

#include "terrain/database/interpolate.hpp"
#include "terrain/database/little_endian.hpp"
#include "terrain/database/zigzag.hpp"

namespace eyepoint::terrain {

namespace {

constexpr std::size_t kHeights = std::size_t{kApronPosts} * kApronPosts;
constexpr std::size_t kPosts = std::size_t{kBlockPosts} * kBlockPosts;
constexpr std::size_t kWaterBytes = (kPosts + 7) / 8;
constexpr std::size_t kHeaderBytes = 22;
constexpr std::size_t kMaxPlanes = 4;
constexpr std::size_t kMaxPayload = kHeaderBytes + kMaxPlanes * kHeights + kWaterBytes;
constexpr int kZstdLevel = 9;

enum class Water : std::uint8_t { None = 0, All = 1, Mixed = 2 };

/// The plane through the west, south and south-west neighbours; modulo 2^32, so no input overflows.
std::uint32_t predict(std::span<const std::uint32_t> heights, std::size_t row, std::size_t column) {
    const std::size_t at = row * kApronPosts + column;
    if (row == 0) return column == 0 ? heights[at] : heights[at - 1];
    if (column == 0) return heights[at - kApronPosts];
    return heights[at - 1] + heights[at - kApronPosts] - heights[at - kApronPosts - 1];
}

Water water_kind(const BlockData& block) {
    const auto wet = std::ranges::count_if(block.water, [](std::uint8_t post) { return post != 0; });
    if (wet == 0) return Water::None;
    return wet == static_cast<std::ptrdiff_t>(kPosts) ? Water::All : Water::Mixed;
}

std::vector<std::uint32_t> residuals(const BlockData& block, double height_step_m, std::uint32_t& first) {
    std::vector<std::uint32_t> heights(kHeights);
    std::ranges::transform(block.heights_m, heights.begin(), [height_step_m](float height_m) {
        return static_cast<std::uint32_t>(to_quanta(height_m, height_step_m));
    });
    first = heights.front();
    std::vector<std::uint32_t> result(kHeights);
    for (std::size_t row = 0; row < kApronPosts; ++row) {
        for (std::size_t column = 0; column < kApronPosts; ++column) {
            const std::size_t at = row * kApronPosts + column;
            result[at] = zigzag(heights[at] - predict(heights, row, column));
        }
    }
    return result;
}

void append_planes(std::vector<std::uint8_t>& payload, std::span<const std::uint32_t> values,
                   std::size_t planes) {
    for (std::size_t plane = 0; plane < planes; ++plane) {
        for (const std::uint32_t value : values)
            payload.push_back(static_cast<std::uint8_t>(value >> (8 * plane)));
    }
}

void append_water(std::vector<std::uint8_t>& payload, const BlockData& block) {
    std::array<std::uint8_t, kWaterBytes> bits{};
    for (std::size_t post = 0; post < kPosts; ++post) {
        if (block.water[post] != 0) bits[post / 8] |= static_cast<std::uint8_t>(1U << (post % 8));
    }
    payload.insert(payload.end(), bits.begin(), bits.end());
}

tl::expected<std::vector<std::uint8_t>, std::string> decompress(std::span<const std::uint8_t> bytes) {
    const unsigned long long declared = ZSTD_getFrameContentSize(bytes.data(), bytes.size());
    if (declared == ZSTD_CONTENTSIZE_ERROR || declared == ZSTD_CONTENTSIZE_UNKNOWN ||
        declared < kHeaderBytes || declared > kMaxPayload) {
        return tl::unexpected(std::string{"the block is no zstd frame of a block's size"});
    }
    std::vector<std::uint8_t> payload(declared);
    const std::size_t size = ZSTD_decompress(payload.data(), payload.size(), bytes.data(), bytes.size());
    if (ZSTD_isError(size) != 0U) {
        return tl::unexpected(fmt::format("the block does not decompress ({})", ZSTD_getErrorName(size)));
    }
    if (size != payload.size()) return tl::unexpected(std::string{"the block is shorter than it says"});
    return payload;
}

void unpack_heights(BlockData& block, std::span<const std::uint8_t> payload, double height_step_m) {
    std::vector<std::uint32_t> heights(kHeights);
    heights.front() = load_le<std::uint32_t>(payload, 18);
    const std::size_t planes = payload[0];
    for (std::size_t row = 0; row < kApronPosts; ++row) {
        for (std::size_t column = 0; column < kApronPosts; ++column) {
            const std::size_t at = row * kApronPosts + column;
            std::uint32_t value = 0;
            for (std::size_t plane = 0; plane < planes; ++plane) {
                value |= std::uint32_t{payload[kHeaderBytes + plane * kHeights + at]} << (8 * plane);
            }
            heights[at] = predict(heights, row, column) + unzigzag(value);
            block.heights_m[at] = to_metres(static_cast<std::int32_t>(heights[at]), height_step_m);
        }
    }
}

}  // namespace

std::vector<std::uint8_t> encode_block(const BlockData& block, double height_step_m) {
    std::uint32_t first = 0;
    const auto values = residuals(block, height_step_m, first);
    const std::uint32_t largest = std::ranges::max(values);
    const auto planes = static_cast<std::size_t>((std::bit_width(largest) + 7) / 8);
    const Water water = water_kind(block);

    std::vector<std::uint8_t> payload;
    payload.reserve(kMaxPayload);
    payload.push_back(static_cast<std::uint8_t>(planes));
    payload.push_back(static_cast<std::uint8_t>(water));
    for (const float undulation_m : block.undulation_m) append_le(payload, undulation_m);
    append_le(payload, first);
    append_planes(payload, values, planes);
    if (water == Water::Mixed) append_water(payload, block);

    std::vector<std::uint8_t> bytes(ZSTD_compressBound(payload.size()));
    bytes.resize(ZSTD_compress(bytes.data(), bytes.size(), payload.data(), payload.size(), kZstdLevel));
    return bytes;
}

tl::expected<BlockData, std::string> decode_block(TileId tile, std::span<const std::uint8_t> bytes,
                                                  double height_step_m) {
    const auto payload = decompress(bytes);
    if (!payload) return tl::unexpected(payload.error());
    const std::size_t planes = (*payload)[0];
    const std::uint8_t water = (*payload)[1];
    if (planes > kMaxPlanes || water > static_cast<std::uint8_t>(Water::Mixed)) {
        return tl::unexpected(fmt::format("the block has {} height planes and water kind {}", planes, water));
    }
    const bool mixed = water == static_cast<std::uint8_t>(Water::Mixed);
    const std::size_t water_at = kHeaderBytes + planes * kHeights;
    if (payload->size() != water_at + (mixed ? kWaterBytes : 0)) {
        return tl::unexpected(fmt::format("the block holds {} bytes where {} belong", payload->size(),
                                          water_at + (mixed ? kWaterBytes : 0)));
    }
    BlockData block;
    block.tile = tile;
    unpack_heights(block, *payload, height_step_m);
    for (std::size_t corner = 0; corner < 4; ++corner) {
        block.undulation_m[corner] = load_float_le(*payload, 2 + 4 * corner);
    }
    if (water == static_cast<std::uint8_t>(Water::All)) block.water.fill(1);
    for (std::size_t post = 0; mixed && post < kPosts; ++post) {
        block.water[post] = ((*payload)[water_at + post / 8] >> (post % 8)) & 1U;
    }
    return block;
}

}  // namespace eyepoint::terrain
