/// A shard: one file with the tiles of a subtree, five depths of it (docs/database-format.md, "Shard").
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "terrain/database/database.hpp"

namespace eyepoint::terrain {

/// Depths a shard holds: its root's and the next four.
inline constexpr std::uint32_t kShardDepths = 5;
/// Tiles of a full shard: 1 + 4 + 16 + 64 + 256.
inline constexpr std::uint32_t kShardTiles = 341;
inline constexpr std::size_t kShardHeaderBytes = 40;
inline constexpr std::size_t kShardEntryBytes = 108;

/// Bytes of a shard file.
struct StoredRange {
    std::uint64_t offset = 0;
    std::uint32_t size = 0;
    std::uint64_t checksum = 0;  ///< XXH3-64 of the bytes
};

struct ShardEntry {
    TileId tile;
    NodeInfo info;
    StoredRange block;
    StoredRange mesh;   ///< size 0 where the tile has none
    StoredRange image;  ///< size 0 where the tile has none
};

/// The root of the shard that holds a tile.
[[nodiscard]] TileId shard_root(TileId tile);
/// shards/DEPTH/X-Y.shard below the database's folder.
[[nodiscard]] std::filesystem::path shard_path(TileId root);

[[nodiscard]] std::uint64_t checksum(std::span<const std::uint8_t> bytes);

/// Header and index. Entries in order of key(tile); their ranges follow one another from the end of the
/// index.
[[nodiscard]] std::vector<std::uint8_t> encode_shard_index(TileId root, std::span<const ShardEntry> entries);

/// Tiles of the shard whose header this is: how long the index is. On failure: the fault, without naming the
/// file.
[[nodiscard]] tl::expected<std::uint32_t, std::string> decode_shard_header(
    TileId root, std::span<const std::uint8_t> header);

/// Checks everything that can be checked without the blocks, against the size of the whole file.
[[nodiscard]] tl::expected<std::vector<ShardEntry>, std::string> decode_shard_index(
    TileId root, std::span<const std::uint8_t> header_and_index, std::uint64_t file_size);

}  // namespace eyepoint::terrain
