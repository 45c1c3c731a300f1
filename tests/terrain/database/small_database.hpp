/// Small databases for tests, in a folder that goes with the test.
#pragma once

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <unistd.h>

#include "terrain/database/database.hpp"
#include "terrain/database/database_writer.hpp"
#include "terrain/database/virtual_tile.hpp"

namespace eyepoint::terrain {

/// A fresh folder, removed with all it holds.
class ScratchFolder {
  public:
    ScratchFolder() {
        std::string name = (std::filesystem::temp_directory_path() / "eyepoint-test-XXXXXX").string();
        path_ = ::mkdtemp(name.data());
    }
    ~ScratchFolder() { std::filesystem::remove_all(path_); }
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

/// A block of a rough surface; every height is a multiple of 1/16 m.
inline BlockData rough_block(TileId tile) {
    BlockData block;
    block.tile = tile;
    for (std::size_t i = 0; i < block.heights_m.size(); ++i) {
        const auto quanta =
            static_cast<int>((i * 2654435761U + tile.x * 40503U + tile.y * 9973U) % 60'000U) - 4'000;
        block.heights_m[i] = static_cast<float>(quanta) / 16.0F;
    }
    for (std::size_t i = 0; i < block.water.size(); ++i) block.water[i] = i % 3 == 0 ? 1 : 0;
    block.undulation_m = {-12.5F, 3.25F, 48.0F, 85.5F};
    return block;
}

inline NodeInfo wide_node() {
    NodeInfo info;
    info.height_min_m = -1'000.0F;
    info.height_max_m = 5'000.0F;
    info.delta_m = {1.0F, 2.0F, 3.0F, 4.0F, 5.0F, 6.0F};
    return info;
}

inline std::vector<std::uint8_t> grey_slope() {
    std::vector<std::uint8_t> rgb;
    for (int texel = 0; texel < kImageTexels * kImageTexels; ++texel) {
        for (int channel = 0; channel < 3; ++channel)
            rgb.push_back(static_cast<std::uint8_t>(texel / kImageTexels + 60));
    }
    return rgb;
}

inline Manifest small_manifest() {
    Manifest manifest;
    manifest.name = "two roots";
    manifest.created_by = "a test";
    manifest.height_step_m = 1.0 / 16.0;
    manifest.max_depth = 0;
    manifest.tiles = 2;
    manifest.image_tiles = 1;
    manifest.voids_filled = 7;
    manifest.detail_extent = {-180.0, -90.0, 180.0, 90.0};
    manifest.sources.push_back({"N46E008.hgt", "elevation", "EGM96", 1.0 / 3600.0, 7});
    return manifest;
}

/// Both root tiles, the western one with an image and a mesh of levels 40 to 63.
inline void write_two_roots(const std::filesystem::path& folder) {
    auto writer = DatabaseWriter::create(folder, 1.0 / 16.0);
    ASSERT_TRUE(writer.has_value()) << writer.error();
    const BlockData west = rough_block({0, 0, 0}), east = rough_block({0, 1, 0});
    const auto rgb = grey_slope();
    ASSERT_TRUE(writer->put({wide_node(), &east, nullptr, std::nullopt}).has_value());
    NodeInfo info = wide_node();
    info.first_level = 40;
    info.last_level = 63;
    const NestedMesh mesh = virtual_mesh({0, 0, 0}, 63);
    ASSERT_TRUE(writer->put({info, &west, &mesh, rgb}).has_value());
    const auto committed = writer->commit(small_manifest());
    ASSERT_TRUE(committed.has_value()) << committed.error();
}

inline std::string bytes_of(const std::filesystem::path& path) {
    std::ifstream file{path, std::ios::binary};
    return {std::istreambuf_iterator<char>{file}, {}};
}

inline void replace_bytes(const std::filesystem::path& path, const std::string& bytes) {
    std::ofstream{path, std::ios::binary | std::ios::trunc}.write(bytes.data(),
                                                                  static_cast<std::streamsize>(bytes.size()));
}

}  // namespace eyepoint::terrain
