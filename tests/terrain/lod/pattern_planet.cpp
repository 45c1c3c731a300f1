#include "tests/terrain/lod/pattern_planet.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "terrain/database/database_writer.hpp"
#include "terrain/database/interpolate.hpp"
#include "terrain/lod/error_level.hpp"
#include "tests/support/analytic_terrain.hpp"

namespace eyepoint::testing {

namespace {

using terrain::BlockData;
using terrain::kBlockCells;
using terrain::kBlockPosts;
using terrain::NestedMesh;
using terrain::TileId;

constexpr double kAmplitudeM = 300.0;

/// The same for a post from every tile that it is on.
std::uint64_t post_hash(TileId tile, int row, int column) {
    const std::uint64_t around = std::uint64_t{terrain::tiles_across(tile.depth)} * kBlockCells;
    const std::uint64_t x =
        (std::uint64_t{tile.x} * kBlockCells + static_cast<std::uint64_t>(column)) % around;
    const std::uint64_t y = std::uint64_t{tile.y} * kBlockCells + static_cast<std::uint64_t>(row);
    std::uint64_t bits = (y << 32 | x) * 0x9e3779b97f4a7c15ULL;
    bits ^= bits >> 29;
    return bits * 0xbf58476d1ce4e5b9ULL >> 40;
}

void check(const tl::expected<void, std::string>& done) {
    if (!done) throw std::runtime_error(done.error());
}

terrain::Manifest manifest_of(const PatternPlanet& planet) {
    terrain::Manifest manifest;
    manifest.name = "pattern";
    manifest.created_by = "a test";
    manifest.height_step_m = kPatternHeightStepM;
    manifest.max_depth = planet.depth;
    for (std::uint32_t depth = 0; depth <= planet.depth; ++depth)
        manifest.tiles += std::uint64_t{2} << (2 * depth);
    manifest.detail_extent = {-180.0, -90.0, 180.0, 90.0};
    manifest.sources.push_back({"formula", "procedural", "WGS84 ellipsoid", 0.1, 0});
    return manifest;
}

}  // namespace

terrain::NodeInfo pattern_node(const PatternPlanet& planet, std::uint32_t depth) {
    terrain::NodeInfo info;
    info.height_min_m = static_cast<float>(-kAmplitudeM);
    info.height_max_m = static_cast<float>(kAmplitudeM * 3.0);
    info.has_children = depth < planet.depth;
    const auto first_at = [&](std::uint32_t at) {
        return static_cast<std::uint8_t>(terrain::bare_level(planet.depth, false) + 4 * (planet.depth - at));
    };
    info.first_level = first_at(depth);
    info.last_level = depth == 0 ? terrain::kLastLevel : first_at(depth - 1);
    return info;
}

BlockData pattern_block(TileId tile) {
    BlockData block;
    block.tile = tile;
    for (int row = -1; row <= kBlockPosts; ++row) {
        for (int column = -1; column <= kBlockPosts; ++column) {
            const double height_m =
                analytic_height_m({.amplitude_m = kAmplitudeM}, terrain::post_latitude_deg(tile, row),
                                  terrain::post_longitude_deg(tile, column));
            block.heights_m[static_cast<std::size_t>((row + 1) * terrain::kApronPosts + column + 1)] =
                terrain::to_metres(terrain::to_quanta(height_m, kPatternHeightStepM), kPatternHeightStepM);
        }
    }
    return block;
}

NestedMesh pattern_mesh(const PatternPlanet& planet, TileId tile) {
    const terrain::NodeInfo info = pattern_node(planet, tile.depth);
    const auto levels = static_cast<std::uint64_t>(std::min(info.last_level - info.first_level, 8));
    NestedMesh mesh;
    mesh.whole_grid = true;
    for (int row = 0; row < kBlockPosts; ++row) {
        for (int column = 0; column < kBlockPosts; ++column) {
            const bool stays = row % 2 == 0 && column % 2 == 0;
            const auto above = planet.one_level ? 0 : post_hash(tile, row, column) % levels;
            mesh.gone_level.push_back(stays ? NestedMesh::kStays
                                            : static_cast<std::uint8_t>(info.last_level - above));
            const int target = row / 2 * 2 * kBlockPosts + column / 2 * 2;
            mesh.target.push_back(static_cast<std::uint16_t>(stays ? 0 : target));
        }
    }
    return mesh;
}

std::shared_ptr<const terrain::Database> make_pattern_database(const PatternPlanet& planet,
                                                               const std::filesystem::path& folder) {
    auto writer = terrain::DatabaseWriter::create(folder, kPatternHeightStepM);
    if (!writer) throw std::runtime_error(writer.error());
    for (std::uint32_t depth = 0; depth <= planet.depth; ++depth) {
        for (std::uint32_t y = 0; y < terrain::tiles_up(depth); ++y) {
            for (std::uint32_t x = 0; x < terrain::tiles_across(depth); ++x) {
                const TileId tile{depth, x, y};
                const BlockData block = pattern_block(tile);
                const NestedMesh mesh = pattern_mesh(planet, tile);
                check(writer->put({pattern_node(planet, depth), &block, &mesh, std::nullopt}));
            }
        }
    }
    check(writer->commit(manifest_of(planet)));
    auto database = terrain::Database::open(folder);
    if (!database) throw std::runtime_error(database.error());
    return std::make_shared<const terrain::Database>(std::move(*database));
}

}  // namespace eyepoint::testing
