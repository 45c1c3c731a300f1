#include "terrain/database/database.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string_view>
#include <system_error>
#include <unordered_map>

#include <fcntl.h>
#include <fmt/format.h>

#include "terrain/database/block_codec.hpp"
#include "terrain/database/durable_file.hpp"
#include "terrain/database/image_codec.hpp"
#include "terrain/database/manifest_json.hpp"
#include "terrain/database/mesh_codec.hpp"
#include "terrain/database/shard.hpp"

namespace eyepoint::terrain {

namespace fs = std::filesystem;

struct Database::Content {
    struct Node {
        NodeInfo info;
        StoredRange block;
        StoredRange mesh;
        StoredRange image;
    };
    fs::path folder;
    Manifest manifest;
    std::unordered_map<TileId, Node, TileHash> nodes;
};

namespace {

constexpr const char* kRebuild = "rebuild the database with eyepoint-terrain";

std::string fault_in(const fs::path& file, std::string_view fault) {
    return fmt::format("{}: {}; {}", file.string(), fault, kRebuild);
}

std::string name_of(TileId tile) { return fmt::format("tile {}/{}-{}", tile.depth, tile.x, tile.y); }

/// The whole of a file of at most limit bytes.
tl::expected<std::vector<std::uint8_t>, std::string> read_file(const fs::path& path, std::uint64_t limit) {
    const OpenFile file{path, O_RDONLY};
    if (!file.is_open()) return tl::unexpected(fmt::format("cannot be opened ({})", std::strerror(errno)));
    std::error_code failure;
    const auto size = fs::file_size(path, failure);
    if (failure || size > limit) return tl::unexpected(std::string{"is no file of a sensible size"});
    return read_range(file, 0, size);
}

tl::expected<Manifest, std::string> read_manifest(const fs::path& folder) {
    constexpr std::uint64_t kMaxManifestBytes = 64U << 20;
    const fs::path path = folder / kManifestFile;
    std::error_code failure;
    if (!fs::is_directory(folder, failure)) {
        return tl::unexpected(fmt::format(
            "{}: there is no such folder; make a terrain database with `eyepoint-terrain synth -o {}`",
            folder.string(), folder.string()));
    }
    if (!fs::exists(path, failure)) {
        return tl::unexpected(
            fmt::format("{}: is no terrain database, it has no {}; make one with `eyepoint-terrain "
                        "build` or `synth`",
                        folder.string(), kManifestFile));
    }
    const auto bytes = read_file(path, kMaxManifestBytes);
    if (!bytes) return tl::unexpected(fault_in(path, bytes.error()));
    auto manifest = manifest_from_json({reinterpret_cast<const char*>(bytes->data()), bytes->size()});
    if (!manifest) return tl::unexpected(fault_in(path, manifest.error()));
    return manifest;
}

tl::expected<std::vector<ShardEntry>, std::string> read_shard(const fs::path& folder, TileId root) {
    const fs::path path = folder / shard_path(root);
    const OpenFile file{path, O_RDONLY};
    if (!file.is_open()) {
        return tl::unexpected(fault_in(path, fmt::format("cannot be opened ({})", std::strerror(errno))));
    }
    std::error_code failure;
    const auto file_size = fs::file_size(path, failure);
    const auto header = read_range(file, 0, kShardHeaderBytes);
    if (failure || !header)
        return tl::unexpected(fault_in(path, header ? failure.message() : header.error()));
    const auto count = decode_shard_header(root, *header);
    if (!count) return tl::unexpected(fault_in(path, count.error()));
    const auto index = read_range(file, 0, kShardHeaderBytes + *count * kShardEntryBytes);
    if (!index) return tl::unexpected(fault_in(path, index.error()));
    auto entries = decode_shard_index(root, *index, file_size);
    if (!entries) return tl::unexpected(fault_in(path, entries.error()));
    return entries;
}

tl::expected<std::vector<std::uint8_t>, std::string> read_checked(const fs::path& path,
                                                                  const StoredRange& range) {
    const OpenFile file{path, O_RDONLY};
    if (!file.is_open()) return tl::unexpected(fmt::format("cannot be opened ({})", std::strerror(errno)));
    auto bytes = read_range(file, range.offset, range.size);
    if (bytes && checksum(*bytes) != range.checksum)
        return tl::unexpected(std::string{"its checksum is wrong"});
    return bytes;
}

}  // namespace

Database::Database(std::unique_ptr<Content> content) : content_(std::move(content)) {}
Database::~Database() = default;
Database::Database(Database&&) noexcept = default;
Database& Database::operator=(Database&&) noexcept = default;

// Shards are reached from the tiles above them, so what is read is whole by construction: a child that its
// parent promises and no shard holds is found here.
tl::expected<Database, std::string> Database::open(const fs::path& folder) {
    auto manifest = read_manifest(folder);
    if (!manifest) return tl::unexpected(manifest.error());
    auto content = std::make_unique<Content>();
    content->folder = folder;
    content->manifest = std::move(*manifest);
    auto& nodes = content->nodes;
    nodes.reserve(std::min<std::uint64_t>(content->manifest.tiles, 1U << 20));

    std::vector<TileId> pending{{0, 0, 0}, {0, 1, 0}};
    std::uint64_t images = 0;
    while (!pending.empty()) {
        const TileId root = pending.back();
        pending.pop_back();
        const auto entries = read_shard(folder, root);
        if (!entries) return tl::unexpected(entries.error());
        const fs::path path = folder / shard_path(root);
        for (const ShardEntry& entry : *entries) {
            nodes.emplace(entry.tile, Content::Node{entry.info, entry.block, entry.mesh, entry.image});
            if (entry.info.has_image) ++images;
            const bool children_elsewhere = (entry.tile.depth + 1) % kShardDepths == 0;
            for (int i = 0; entry.info.has_children && children_elsewhere && i < 4; ++i) {
                pending.push_back(child(entry.tile, i));
            }
        }
    }
    for (const auto& [tile, node] : nodes) {
        const bool parent_says = tile.depth == 0 || (nodes.contains(parent(tile)) &&
                                                     nodes.find(parent(tile))->second.info.has_children);
        bool whole = parent_says;
        for (int i = 0; node.info.has_children && i < 4; ++i) whole = whole && nodes.contains(child(tile, i));
        if (!whole) {
            return tl::unexpected(fault_in(folder / shard_path(shard_root(tile)),
                                           "the tree of tiles is not whole at " + name_of(tile)));
        }
    }
    if (nodes.size() != content->manifest.tiles || images != content->manifest.image_tiles) {
        return tl::unexpected(fault_in(
            folder / kManifestFile,
            fmt::format("it promises {} tiles and {} images, the shards hold {} and {}",
                        content->manifest.tiles, content->manifest.image_tiles, nodes.size(), images)));
    }
    return Database{std::move(content)};
}

const Manifest& Database::manifest() const { return content_->manifest; }
const fs::path& Database::folder() const { return content_->folder; }

const NodeInfo* Database::find(TileId tile) const {
    const auto found = content_->nodes.find(tile);
    return found == content_->nodes.end() ? nullptr : &found->second.info;
}

tl::expected<BlockData, std::string> Database::read_block(TileId tile) const {
    const fs::path path = content_->folder / shard_path(shard_root(tile));
    const auto found = content_->nodes.find(tile);
    if (found == content_->nodes.end()) {
        return tl::unexpected(
            fmt::format("{}: the database does not hold {}", folder().string(), name_of(tile)));
    }
    auto block =
        read_checked(path, found->second.block).and_then([&](const std::vector<std::uint8_t>& bytes) {
            return decode_block(tile, bytes, content_->manifest.height_step_m);
        });
    if (!block)
        return tl::unexpected(fault_in(path, fmt::format("block of {}: {}", name_of(tile), block.error())));
    return block;
}

tl::expected<NestedMesh, std::string> Database::read_mesh(TileId tile) const {
    const fs::path path = content_->folder / shard_path(shard_root(tile));
    const auto found = content_->nodes.find(tile);
    if (found == content_->nodes.end() || found->second.mesh.size == 0) {
        return tl::unexpected(fmt::format("{}: the database holds no mesh of {}; {}", folder().string(),
                                          name_of(tile), kRebuild));
    }
    const Content::Node& node = found->second;
    auto mesh = read_checked(path, node.mesh).and_then([&](const std::vector<std::uint8_t>& bytes) {
        return decode_mesh(bytes, node.info.first_level, node.info.last_level,
                           content_->manifest.height_step_m);
    });
    if (!mesh)
        return tl::unexpected(fault_in(path, fmt::format("mesh of {}: {}", name_of(tile), mesh.error())));
    return mesh;
}

tl::expected<ImageData, std::string> Database::read_image(TileId tile) const {
    const fs::path path = content_->folder / shard_path(shard_root(tile));
    const auto found = content_->nodes.find(tile);
    if (found == content_->nodes.end() || !found->second.info.has_image) {
        return tl::unexpected(
            fmt::format("{}: the database holds no image of {}", folder().string(), name_of(tile)));
    }
    auto image =
        read_checked(path, found->second.image).and_then([&](const std::vector<std::uint8_t>& bytes) {
            return decode_image(tile, bytes);
        });
    if (!image)
        return tl::unexpected(fault_in(path, fmt::format("image of {}: {}", name_of(tile), image.error())));
    return image;
}

StoredBytes Database::stored_bytes() const {
    StoredBytes bytes;
    for (const auto& [tile, node] : content_->nodes) {
        bytes.blocks += node.block.size;
        bytes.meshes += node.mesh.size;
        bytes.images += node.image.size;
    }
    return bytes;
}

std::vector<TileId> Database::tiles() const {
    std::vector<TileId> result;
    result.reserve(content_->nodes.size());
    for (const auto& [tile, node] : content_->nodes) result.push_back(tile);
    return result;
}

}  // namespace eyepoint::terrain
