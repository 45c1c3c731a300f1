#include "tools/terrain/compile_block.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "terrain/database/interpolate.hpp"

namespace eyepoint::tools {

using namespace terrain;

namespace {

void copy_parents_posts(QuantisedBlock& block, const QuantisedBlock& parent) {
    const int south = quadrant(block.tile) / 2 * kBlockCells / 2;
    const int west = quadrant(block.tile) % 2 * kBlockCells / 2;
    for (int row = 0; row < kBlockPosts; row += 2) {
        for (int column = 0; column < kBlockPosts; column += 2) {
            const int parent_row = south + row / 2;
            const int parent_column = west + column / 2;
            block.height(row, column) = parent.height(parent_row, parent_column);
            block.water[static_cast<std::size_t>(row * kBlockPosts + column)] =
                parent.water[static_cast<std::size_t>(parent_row * kBlockPosts + parent_column)];
        }
    }
}

}  // namespace

tl::expected<QuantisedBlock, std::string> BlockMaker::make(TileId tile, const QuantisedBlock* parent) const {
    auto block = sample(tile);
    if (!block) return block;
    if (tile.x + 1 == tiles_across(tile.depth)) sample_column(*block, kBlockCells, -180.0);
    if (tile.y == 0) level_pole(*block, 0, -90.0);
    if (tile.y + 1 == tiles_up(tile.depth)) level_pole(*block, kBlockCells, 90.0);
    if (parent != nullptr) copy_parents_posts(*block, *parent);
    match_coarser_edges(*block);
    return block;
}

tl::expected<QuantisedBlock, std::string> BlockMaker::sample(TileId tile) const {
    const double step_deg = post_spacing_deg(tile.depth);
    const Lattice lattice{post_latitude_deg(tile, -1), extent(tile).west_deg - step_deg, step_deg,
                          kApronPosts, kApronPosts};
    std::array<SurfaceSample, kApronPosts * kApronPosts> samples;
    source_.sample(lattice, samples);
    QuantisedBlock block;
    block.tile = tile;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        if (!(std::abs(samples[i].ellipsoidal_height_m) < 1e5F)) {
            return tl::unexpected(
                fmt::format("the elevation in tile {}/{}-{} (south-west corner {} N {} E) is no height: {} m",
                            tile.depth, tile.x, tile.y, extent(tile).south_deg, extent(tile).west_deg,
                            samples[i].ellipsoidal_height_m));
        }
        block.heights[i] = to_quanta(samples[i].ellipsoidal_height_m, height_step_m_);
    }
    for (std::size_t row = 0; row < kBlockPosts; ++row) {
        for (std::size_t column = 0; column < kBlockPosts; ++column) {
            block.water[row * kBlockPosts + column] =
                samples[(row + 1) * kApronPosts + column + 1].water ? std::uint8_t{1} : std::uint8_t{0};
        }
    }
    return block;
}

void BlockMaker::sample_column(QuantisedBlock& block, int column, double longitude_deg) const {
    std::array<SurfaceSample, kBlockPosts> samples;
    source_.sample(
        {extent(block.tile).south_deg, longitude_deg, post_spacing_deg(block.tile.depth), kBlockPosts, 1},
        samples);
    for (int row = 0; row < kBlockPosts; ++row) {
        const SurfaceSample& sample = samples[static_cast<std::size_t>(row)];
        block.height(row, column) = to_quanta(sample.ellipsoidal_height_m, height_step_m_);
        block.water[static_cast<std::size_t>(row * kBlockPosts + column)] = sample.water ? 1 : 0;
    }
}

void BlockMaker::level_pole(QuantisedBlock& block, int row, double latitude_deg) const {
    SurfaceSample pole;
    source_.sample({latitude_deg, -180.0, 1.0, 1, 1}, {&pole, 1});
    for (int column = 0; column < kBlockPosts; ++column) {
        block.height(row, column) = to_quanta(pole.ellipsoidal_height_m, height_step_m_);
        block.water[static_cast<std::size_t>(row * kBlockPosts + column)] = pole.water ? 1 : 0;
    }
}

void BlockMaker::match_coarser_edges(QuantisedBlock& block) const {
    for (const Edge edge : kEdges) {
        const auto beyond = neighbour(block.tile, edge);
        if (!beyond || plan_.contains(*beyond)) continue;
        const bool along_row = edge == Edge::South || edge == Edge::North;
        const int fixed = edge == Edge::South || edge == Edge::West ? 0 : kBlockCells;
        for (int post = 1; post < kBlockCells; post += 2) {
            if (along_row) {
                block.height(fixed, post) =
                    midpoint(block.height(fixed, post - 1), block.height(fixed, post + 1));
            } else {
                block.height(post, fixed) =
                    midpoint(block.height(post - 1, fixed), block.height(post + 1, fixed));
            }
        }
    }
}

BlockData BlockMaker::finish(const QuantisedBlock& block, const Geoid& geoid) const {
    BlockData result;
    result.tile = block.tile;
    std::ranges::transform(block.heights, result.heights_m.begin(),
                           [this](std::int32_t quanta) { return to_metres(quanta, height_step_m_); });
    result.water = block.water;
    const auto sides = extent(block.tile);
    for (std::size_t corner = 0; corner < 4; ++corner) {
        result.undulation_m[corner] =
            static_cast<float>(geoid.undulation_m((corner & 2U) != 0 ? sides.north_deg : sides.south_deg,
                                                  (corner & 1U) != 0 ? sides.east_deg : sides.west_deg));
    }
    return result;
}

}  // namespace eyepoint::tools
