#include "terrain/database/database_writer.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <map>
#include <mutex>
#include <system_error>

#include <sys/file.h>
#include <sys/stat.h>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "terrain/database/block_codec.hpp"
#include "terrain/database/durable_file.hpp"
#include "terrain/database/image_codec.hpp"
#include "terrain/database/manifest_json.hpp"
#include "terrain/database/mesh_codec.hpp"
#include "terrain/database/shard.hpp"

namespace eyepoint::terrain {

namespace fs = std::filesystem;

/// A shard being gathered. Tiles arrive in any order; their bytes lie in the spill file up to `spilled`, then
/// in `pending`. Offsets count over both.
struct GatheredShard {
    std::vector<ShardEntry> entries;
    std::vector<std::uint8_t> pending;
    std::uint64_t spilled = 0;
};

struct ByKey {
    bool operator()(TileId a, TileId b) const { return key(a) < key(b); }
};

namespace {

/// Encoded tiles held in memory before they are spilled to disk.
constexpr std::size_t kMaxPendingBytes = std::size_t{256} << 20;
constexpr const char* kPartialMark = ".partial-";

/// Whether the folder may be replaced: not there, empty, or a terrain database.
tl::expected<void, std::string> check_place(const fs::path& folder) {
    std::error_code failure;
    const auto kind = fs::status(folder, failure).type();
    if (kind == fs::file_type::not_found) return {};
    const bool ours = fs::is_directory(folder, failure) &&
                      (fs::is_empty(folder, failure) || fs::exists(folder / kManifestFile, failure));
    if (ours) return {};
    return tl::unexpected(fmt::format(
        "{}: exists and is no terrain database, so it is not replaced; name another place", folder.string()));
}

/// The partial folder is locked (flock) by whoever writes it, so a lock that can be had marks what a killed
/// writer left behind.
bool remove_if_stale(const fs::path& partial) {
    const OpenFile file{partial, O_RDONLY | O_DIRECTORY};
    if (!file.is_open()) return errno == ENOENT;
    if (::flock(file.descriptor(), LOCK_EX | LOCK_NB) != 0) return false;
    std::error_code failure;
    fs::remove_all(partial, failure);
    return !failure;
}

std::string busy(const fs::path& folder) {
    return fmt::format(
        "{}: another eyepoint-terrain is writing this database; wait for it or name another place",
        folder.string());
}

tl::expected<void, std::string> clear_stale(const fs::path& folder) {
    const std::string prefix = folder.filename().string() + kPartialMark;
    std::error_code failure;
    std::vector<fs::path> partials;
    for (const auto& entry : fs::directory_iterator{folder.parent_path(), failure}) {
        if (entry.path().filename().string().starts_with(prefix)) partials.push_back(entry.path());
    }
    for (const fs::path& partial : partials) {
        if (!remove_if_stale(partial)) return tl::unexpected(busy(folder));
    }
    return {};
}

/// Puts the whole partial folder in the final place; what was there before is then at partial.
bool exchange(const fs::path& partial, const fs::path& folder) {
    if (::renameat2(AT_FDCWD, partial.c_str(), AT_FDCWD, folder.c_str(), RENAME_EXCHANGE) == 0) return true;
    const fs::path old = partial.string() + "-old";
    return ::rename(folder.c_str(), old.c_str()) == 0 && ::rename(partial.c_str(), folder.c_str()) == 0 &&
           ::rename(old.c_str(), partial.c_str()) == 0;
}

}  // namespace

struct DatabaseWriter::State {
    fs::path folder;
    fs::path partial;
    OpenFile lock;  ///< of the partial folder, held while this writer lives
    double height_step_m = 0.0;
    bool partial_exists = false;

    std::mutex mutex;  ///< guards what follows
    std::map<TileId, GatheredShard, ByKey> shards;
    std::size_t pending_bytes = 0;

    ~State() {
        std::error_code ignored;
        if (partial_exists) fs::remove_all(partial, ignored);
    }

    [[nodiscard]] fs::path spill_path(TileId root) const {
        return (partial / shard_path(root)).string() + ".spill";
    }
    tl::expected<void, std::string> spill();
    tl::expected<void, std::string> finish_shard(TileId root, GatheredShard& shard) const;
    tl::expected<void, std::string> sync_folders() const;
    tl::expected<void, std::string> move_into_place();
};

tl::expected<void, std::string> DatabaseWriter::State::spill() {
    for (auto& [root, shard] : shards) {
        if (shard.pending.empty()) continue;
        const fs::path path = spill_path(root);
        std::error_code failure;
        fs::create_directories(path.parent_path(), failure);
        std::FILE* file = std::fopen(path.c_str(), "ab");
        const bool written = file != nullptr && std::fwrite(shard.pending.data(), 1, shard.pending.size(),
                                                            file) == shard.pending.size();
        if (file == nullptr || std::fclose(file) != 0 || !written) {
            return tl::unexpected(fmt::format("{}: cannot be written ({}); is the disk full?", path.string(),
                                              std::strerror(errno)));
        }
        shard.spilled += shard.pending.size();
        shard.pending = {};
    }
    pending_bytes = 0;
    return {};
}

// Tiles are laid down in the order of their keys, whatever the order they came in: the same content gives the
// same file.
tl::expected<void, std::string> DatabaseWriter::State::finish_shard(TileId root, GatheredShard& shard) const {
    const fs::path path = partial / shard_path(root);
    std::error_code failure;
    fs::create_directories(path.parent_path(), failure);
    std::vector<std::uint8_t> gathered;
    if (shard.spilled > 0) {
        const OpenFile file{spill_path(root), O_RDONLY};
        auto bytes = read_range(file, 0, shard.spilled);
        if (!bytes) return tl::unexpected(fmt::format("{}: {}", spill_path(root).string(), bytes.error()));
        gathered = std::move(*bytes);
        fs::remove(spill_path(root), failure);
    }
    gathered.insert(gathered.end(), shard.pending.begin(), shard.pending.end());
    shard.pending = {};

    std::ranges::sort(shard.entries, {}, [](const ShardEntry& entry) { return key(entry.tile); });
    std::vector<std::uint8_t> body;
    body.reserve(gathered.size());
    const std::uint64_t body_at = kShardHeaderBytes + shard.entries.size() * kShardEntryBytes;
    const auto lay_down = [&](StoredRange& range) {
        const auto from = gathered.begin() + static_cast<std::ptrdiff_t>(range.offset);
        range.offset = body_at + body.size();
        body.insert(body.end(), from, from + range.size);
    };
    for (ShardEntry& entry : shard.entries) {
        lay_down(entry.block);
        lay_down(entry.mesh);
        lay_down(entry.image);
    }
    return write_durably(path, {encode_shard_index(root, shard.entries), body});
}

tl::expected<void, std::string> DatabaseWriter::State::sync_folders() const {
    for (const auto& entry : fs::recursive_directory_iterator{partial}) {
        if (!entry.is_directory()) continue;
        if (auto synced = sync_folder(entry.path()); !synced) return synced;
    }
    return sync_folder(partial);
}

tl::expected<void, std::string> DatabaseWriter::State::move_into_place() {
    if (auto free = check_place(folder); !free) return free;
    std::error_code failure;
    const bool replaces = fs::exists(folder, failure);
    const bool moved = replaces ? exchange(partial, folder) : ::rename(partial.c_str(), folder.c_str()) == 0;
    if (!moved) {
        return tl::unexpected(
            fmt::format("{}: cannot be put in place ({})", folder.string(), std::strerror(errno)));
    }
    partial_exists = replaces;
    return sync_folder(folder.parent_path());
}

DatabaseWriter::DatabaseWriter(std::unique_ptr<State> state) : state_(std::move(state)) {}
DatabaseWriter::~DatabaseWriter() = default;
DatabaseWriter::DatabaseWriter(DatabaseWriter&&) noexcept = default;
DatabaseWriter& DatabaseWriter::operator=(DatabaseWriter&&) noexcept = default;

tl::expected<DatabaseWriter, std::string> DatabaseWriter::create(const fs::path& folder,
                                                                 double height_step_m) {
    auto state = std::make_unique<State>();
    std::error_code failure;
    state->folder = fs::absolute(folder, failure).lexically_normal();
    if (state->folder.filename().empty()) state->folder = state->folder.parent_path();
    state->height_step_m = height_step_m;
    state->partial = state->folder.string() + kPartialMark + std::to_string(::getpid());
    if (auto free = check_place(state->folder); !free) return tl::unexpected(free.error());
    fs::create_directories(state->folder.parent_path(), failure);
    if (auto cleared = clear_stale(state->folder); !cleared) return tl::unexpected(cleared.error());
    if (::mkdir(state->partial.c_str(), 0777) != 0) {
        return tl::unexpected(fmt::format("{}: cannot be made ({}); name a place that can be written to",
                                          state->folder.string(), std::strerror(errno)));
    }
    state->partial_exists = true;
    state->lock = OpenFile{state->partial, O_RDONLY | O_DIRECTORY};
    struct stat locked {};
    if (!state->lock.is_open() || ::flock(state->lock.descriptor(), LOCK_EX | LOCK_NB) != 0 ||
        ::fstat(state->lock.descriptor(), &locked) != 0 || locked.st_nlink == 0) {
        state->partial_exists = false;
        return tl::unexpected(busy(state->folder));
    }
    return DatabaseWriter{std::move(state)};
}

tl::expected<void, std::string> DatabaseWriter::put(const Tile& tile) {
    ShardEntry entry{tile.block->tile, tile.info, {}, {}, {}};
    entry.info.has_image = tile.image_rgb.has_value();
    const auto block = encode_block(*tile.block, state_->height_step_m);
    std::vector<std::uint8_t> mesh;
    if (tile.mesh != nullptr) {
        auto encoded =
            encode_mesh(*tile.mesh, tile.info.first_level, tile.info.last_level, state_->height_step_m);
        if (!encoded) {
            return tl::unexpected(fmt::format("mesh of tile {}/{}-{}: {}", entry.tile.depth, entry.tile.x,
                                              entry.tile.y, encoded.error()));
        }
        mesh = std::move(*encoded);
    }
    std::vector<std::uint8_t> image;
    if (tile.image_rgb) {
        auto encoded = encode_image(*tile.image_rgb);
        if (!encoded) return tl::unexpected(encoded.error());
        image = std::move(*encoded);
    }
    const std::lock_guard guard{state_->mutex};
    GatheredShard& shard = state_->shards[shard_root(entry.tile)];
    const auto gather = [&](const std::vector<std::uint8_t>& bytes) {
        const StoredRange range{shard.spilled + shard.pending.size(),
                                static_cast<std::uint32_t>(bytes.size()), checksum(bytes)};
        shard.pending.insert(shard.pending.end(), bytes.begin(), bytes.end());
        state_->pending_bytes += bytes.size();
        return range;
    };
    entry.block = gather(block);
    entry.mesh = gather(mesh);
    entry.image = gather(image);
    shard.entries.push_back(entry);
    return state_->pending_bytes > kMaxPendingBytes ? state_->spill() : tl::expected<void, std::string>{};
}

tl::expected<void, std::string> DatabaseWriter::commit(const Manifest& manifest) {
    const std::lock_guard guard{state_->mutex};
    for (auto& [root, shard] : state_->shards) {
        if (auto written = state_->finish_shard(root, shard); !written) return written;
    }
    const std::string text = to_json(manifest);
    const std::span<const std::uint8_t> bytes{reinterpret_cast<const std::uint8_t*>(text.data()),
                                              text.size()};
    if (auto written = write_durably(state_->partial / kManifestFile, {bytes}); !written) return written;
    if (auto synced = state_->sync_folders(); !synced) return synced;
    return state_->move_into_place();
}

}  // namespace eyepoint::terrain
