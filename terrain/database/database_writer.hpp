/// Writing a terrain database: whole or absent, never half.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "terrain/database/database.hpp"

namespace eyepoint::terrain {

/// Writes shards beside the final place (FOLDER.partial-PID) and renames the folder when everything is on
/// disk (fsync of files and folders first). If the writer is destroyed before commit(), nothing is left. A
/// database already at the final place is replaced only by commit(), and only if it is a terrain database.
/// Thread use: put() may be called from several threads; the rest from one.
class DatabaseWriter {
  public:
    struct Tile {
        NodeInfo info;
        const BlockData* block = nullptr;
        const NestedMesh* mesh = nullptr;                        ///< nullptr: none is stored
        std::optional<std::span<const std::uint8_t>> image_rgb;  ///< kImageTexels^2 * 3 bytes
    };

    /// height_step_m: the quantum heights are stored in. On failure: one sentence (unwritable, exists and is
    /// no database, another writer at work).
    [[nodiscard]] static tl::expected<DatabaseWriter, std::string> create(const std::filesystem::path& folder,
                                                                          double height_step_m);
    ~DatabaseWriter();
    DatabaseWriter(DatabaseWriter&&) noexcept;
    DatabaseWriter& operator=(DatabaseWriter&&) noexcept;

    /// On failure: one sentence (a mesh or picture that is not whole, or the disk full).
    [[nodiscard]] tl::expected<void, std::string> put(const Tile& tile);
    [[nodiscard]] tl::expected<void, std::string> commit(const Manifest& manifest);

  private:
    struct State;
    explicit DatabaseWriter(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace eyepoint::terrain
