#include "terrain/database/shard.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <xxhash.h>

#include "terrain/database/little_endian.hpp"
#include "terrain/lod/error_level.hpp"

namespace eyepoint::terrain {

namespace {

constexpr std::array<std::uint8_t, 8> kMagic{'E', 'Y', 'E', 'S', 'H', 'A', 'R', 'D'};
constexpr std::size_t kChecksumAt = 32;
constexpr std::uint32_t kHasChildren = 1;
constexpr std::uint32_t kHasImage = 2;
constexpr int kFirstLevelShift = 8;
constexpr int kLastLevelShift = 16;

/// Of everything in the header and the index but the field that holds it.
std::uint64_t index_checksum(std::span<const std::uint8_t> bytes) {
    std::vector<std::uint8_t> covered{bytes.begin(), bytes.end()};
    covered.erase(covered.begin() + kChecksumAt, covered.begin() + kShardHeaderBytes);
    return checksum(covered);
}

void append_range(std::vector<std::uint8_t>& bytes, const StoredRange& range) {
    append_le(bytes, range.offset);
    append_le(bytes, range.size);
    append_le(bytes, range.checksum);
}

void append_entry(std::vector<std::uint8_t>& bytes, const ShardEntry& entry) {
    append_le(bytes, entry.tile.depth);
    append_le(bytes, entry.tile.x);
    append_le(bytes, entry.tile.y);
    append_le(bytes, (entry.info.has_children ? kHasChildren : 0U) | (entry.info.has_image ? kHasImage : 0U) |
                         std::uint32_t{entry.info.first_level} << kFirstLevelShift |
                         std::uint32_t{entry.info.last_level} << kLastLevelShift);
    append_le(bytes, entry.info.height_min_m);
    append_le(bytes, entry.info.height_max_m);
    for (const float delta_m : entry.info.delta_m) append_le(bytes, delta_m);
    append_range(bytes, entry.block);
    append_range(bytes, entry.mesh);
    append_range(bytes, entry.image);
}

StoredRange load_range(std::span<const std::uint8_t> bytes, std::size_t at) {
    return {load_le<std::uint64_t>(bytes, at), load_le<std::uint32_t>(bytes, at + 8),
            load_le<std::uint64_t>(bytes, at + 12)};
}

ShardEntry load_entry(std::span<const std::uint8_t> bytes, std::size_t at) {
    ShardEntry entry;
    entry.tile = {load_le<std::uint32_t>(bytes, at), load_le<std::uint32_t>(bytes, at + 4),
                  load_le<std::uint32_t>(bytes, at + 8)};
    const auto flags = load_le<std::uint32_t>(bytes, at + 12);
    entry.info.has_children = (flags & kHasChildren) != 0;
    entry.info.has_image = (flags & kHasImage) != 0;
    entry.info.first_level = static_cast<std::uint8_t>(flags >> kFirstLevelShift);
    entry.info.last_level = static_cast<std::uint8_t>(flags >> kLastLevelShift);
    entry.info.height_min_m = load_float_le(bytes, at + 16);
    entry.info.height_max_m = load_float_le(bytes, at + 20);
    for (std::size_t level = 0; level < kBlockLevels; ++level) {
        entry.info.delta_m[level] = load_float_le(bytes, at + 24 + 4 * level);
    }
    entry.block = load_range(bytes, at + 48);
    entry.mesh = load_range(bytes, at + 68);
    entry.image = load_range(bytes, at + 88);
    return entry;
}

bool is_sound(const NodeInfo& info) {
    const bool finite =
        std::isfinite(info.height_min_m) && std::isfinite(info.height_max_m) &&
        std::ranges::all_of(info.delta_m, [](float delta_m) { return std::isfinite(delta_m); });
    const bool levels = info.first_level <= info.last_level && info.last_level <= kLastLevel;
    return finite && levels && info.height_min_m <= info.height_max_m && info.delta_m[0] >= 0.0F &&
           std::ranges::is_sorted(info.delta_m);
}

bool is_in_shard(TileId tile, TileId root) { return is_valid(tile) && shard_root(tile) == root; }

}  // namespace

TileId shard_root(TileId tile) { return ancestor(tile, tile.depth / kShardDepths * kShardDepths); }

std::filesystem::path shard_path(TileId root) {
    return fmt::format("shards/{}/{}-{}.shard", root.depth, root.x, root.y);
}

std::uint64_t checksum(std::span<const std::uint8_t> bytes) {
    return XXH3_64bits(bytes.data(), bytes.size());
}

std::vector<std::uint8_t> encode_shard_index(TileId root, std::span<const ShardEntry> entries) {
    std::vector<std::uint8_t> bytes{kMagic.begin(), kMagic.end()};
    bytes.reserve(kShardHeaderBytes + entries.size() * kShardEntryBytes);
    append_le(bytes, static_cast<std::uint32_t>(Manifest::kFormatVersion));
    append_le(bytes, root.depth);
    append_le(bytes, root.x);
    append_le(bytes, root.y);
    append_le(bytes, static_cast<std::uint32_t>(entries.size()));
    append_le(bytes, std::uint32_t{0});
    append_le(bytes, std::uint64_t{0});
    for (const ShardEntry& entry : entries) append_entry(bytes, entry);
    std::vector<std::uint8_t> sum;
    append_le(sum, index_checksum(bytes));
    std::ranges::copy(sum, bytes.begin() + kChecksumAt);
    return bytes;
}

tl::expected<std::uint32_t, std::string> decode_shard_header(TileId root,
                                                             std::span<const std::uint8_t> header) {
    if (header.size() < kShardHeaderBytes) {
        return tl::unexpected(
            fmt::format("it is {} bytes long, shorter than a shard's header", header.size()));
    }
    if (!std::ranges::equal(header.first(kMagic.size()), kMagic)) {
        return tl::unexpected(std::string{"it does not start as a shard does"});
    }
    const auto version = load_le<std::uint32_t>(header, 8);
    if (version != Manifest::kFormatVersion) {
        return tl::unexpected(fmt::format("its format is version {}, this program reads version {}", version,
                                          Manifest::kFormatVersion));
    }
    const TileId written{load_le<std::uint32_t>(header, 12), load_le<std::uint32_t>(header, 16),
                         load_le<std::uint32_t>(header, 20)};
    if (written != root) {
        return tl::unexpected(fmt::format("it holds tile {}/{}-{}, not the one it is named after",
                                          written.depth, written.x, written.y));
    }
    const auto count = load_le<std::uint32_t>(header, 24);
    if (count == 0 || count > kShardTiles || load_le<std::uint32_t>(header, 28) != 0) {
        return tl::unexpected(fmt::format("its header claims {} tiles", count));
    }
    return count;
}

tl::expected<std::vector<ShardEntry>, std::string> decode_shard_index(
    TileId root, std::span<const std::uint8_t> header_and_index, std::uint64_t file_size) {
    const auto count = decode_shard_header(root, header_and_index);
    if (!count) return tl::unexpected(count.error());
    const std::size_t index_end = kShardHeaderBytes + *count * kShardEntryBytes;
    if (header_and_index.size() != index_end) return tl::unexpected(std::string{"its index is cut short"});
    if (index_checksum(header_and_index) != load_le<std::uint64_t>(header_and_index, kChecksumAt)) {
        return tl::unexpected(std::string{"the checksum of its index is wrong"});
    }
    std::vector<ShardEntry> entries;
    entries.reserve(*count);
    std::uint64_t end = index_end;
    for (std::uint32_t i = 0; i < *count; ++i) {
        const ShardEntry entry = load_entry(header_and_index, kShardHeaderBytes + i * kShardEntryBytes);
        const bool ordered = entries.empty() || key(entries.back().tile) < key(entry.tile);
        const bool chained = entry.block.offset == end && entry.block.size > 0 &&
                             entry.mesh.offset == end + entry.block.size &&
                             entry.image.offset == entry.mesh.offset + entry.mesh.size &&
                             (entry.image.size > 0) == entry.info.has_image;
        if (!is_in_shard(entry.tile, root) || !ordered || !chained || !is_sound(entry.info)) {
            return tl::unexpected(fmt::format("entry {} of its index is not valid", i));
        }
        end = entry.image.offset + entry.image.size;
        entries.push_back(entry);
    }
    if (end != file_size) {
        return tl::unexpected(fmt::format("it is {} bytes long where its index asks for {}", file_size, end));
    }
    return entries;
}

}  // namespace eyepoint::terrain
