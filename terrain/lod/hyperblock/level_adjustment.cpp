#include "terrain/lod/hyperblock/level_adjustment.hpp"

#include <algorithm>
#include <cstddef>

namespace eyepoint::terrain::hyperblock {

namespace {

/// The level of the planet's quadtree that a block is drawn at.
int planet_level(const TileBlocks& tile, const BlockChoice& choice) {
    return static_cast<int>(tile.tile.depth) + choice.depth + choice.level;
}

/// Calls `see` with the blocks of other tiles across a tile's edge, from its i-th quad of hyperLevel.
template <typename See>
void for_each_across_tile(const TileBlocks& tile, Edge edge, int i, const See& see) {
    const auto& across = tile.across[static_cast<std::size_t>(edge)];
    const bool upright = edge == Edge::West || edge == Edge::East;
    const auto see_at = [&](TileBlocks* beside, int along) {
        if (beside == nullptr) return;
        const int side = beside->tree.side();
        const int near_side = edge == Edge::West || edge == Edge::South ? side - 1 : 0;
        see(*beside, upright ? beside->tree.at(along, near_side) : beside->tree.at(near_side, along));
    };
    const int side = tile.tree.side();
    if (across[0] != across[1]) {
        for (int along = 2 * i; along < 2 * i + 2; ++along)
            see_at(across[static_cast<std::size_t>(along / side)], along % side);
        return;
    }
    if (across[0] == nullptr) return;
    if (across[0]->tile.depth == tile.tile.depth) return see_at(across[0], i);
    const auto half = static_cast<int>((upright ? tile.tile.y : tile.tile.x) & 1U);
    see_at(across[0], (half * side + i) / 2);
}

/// Calls `see` with the blocks across an edge of a block of hyperLevel.
template <typename See>
void for_each_across(TileBlocks& tile, int row, int column, Edge edge, const See& see) {
    const int last = tile.tree.side() - 1;
    switch (edge) {
        case Edge::West:
            return column > 0 ? see(tile, tile.tree.at(row, column - 1))
                              : for_each_across_tile(tile, edge, row, see);
        case Edge::East:
            return column < last ? see(tile, tile.tree.at(row, column + 1))
                                 : for_each_across_tile(tile, edge, row, see);
        case Edge::South:
            return row > 0 ? see(tile, tile.tree.at(row - 1, column))
                           : for_each_across_tile(tile, edge, column, see);
        case Edge::North:
            return row < last ? see(tile, tile.tree.at(row + 1, column))
                              : for_each_across_tile(tile, edge, column, see);
    }
}

/// Blocks that end early have no levels to differ by.
bool is_of_hyper_level(const TileBlocks& tile, const BlockChoice& choice) {
    return choice.depth == tile.tree.hyper_level;
}

void set_border_type(TileBlocks& tile, int row, int column) {
    const std::uint8_t number = tile.tree.at(row, column);
    BlockChoice& choice = tile.choices[number];
    if (!choice.selected() || !is_of_hyper_level(tile, choice)) return;
    const int level = planet_level(tile, choice);
    unsigned border = 0;
    for (std::size_t edge = 0; edge < kEdges.size(); ++edge) {
        for_each_across(tile, row, column, kEdges[edge], [&](const TileBlocks& other, std::uint8_t beside) {
            const BlockChoice& theirs = other.choices[beside];
            const bool finer = theirs.selected() && planet_level(other, theirs) > level;
            border |= finer ? 1U << edge : 0U;
        });
    }
    if (border == 0) return;
    choice.border = static_cast<BorderType>(border & tile.tree.blocks[number].level(choice.level).extendable);
}

template <typename Visit>
void for_each_quad(std::span<TileBlocks* const> tiles, const Visit& visit) {
    for (TileBlocks* tile : tiles) {
        for (int row = 0; row < tile->tree.side(); ++row)
            for (int column = 0; column < tile->tree.side(); ++column) visit(*tile, row, column);
    }
}

}  // namespace

/// A block of level 0 asks nothing of its neighbours.
void LevelAdjustment::note(TileBlocks& tile, int row, int column) {
    const BlockChoice& choice = tile.choices[tile.tree.at(row, column)];
    if (choice.level <= 0 || !is_of_hyper_level(tile, choice)) return;
    by_level_[static_cast<std::size_t>(planet_level(tile, choice))].push_back({&tile, row, column});
}

void LevelAdjustment::raise_around(const Place& place, int level) {
    for (const Edge edge : kEdges) {
        for_each_across(
            *place.tile, place.row, place.column, edge, [&](TileBlocks& other, std::uint8_t beside) {
                BlockChoice& choice = other.choices[beside];
                const int lacking = level - 1 - planet_level(other, choice);
                if (!choice.selected() || lacking <= 0) return;
                const HyperBlock& block = other.tree.blocks[beside];
                if (choice.level == block.finest()) return;
                choice.level = static_cast<std::int8_t>(std::min(choice.level + lacking, block.finest()));
                note(other, block.row, block.column);
            });
    }
}

void LevelAdjustment::adjust(std::span<TileBlocks* const> tiles) {
    by_level_.resize(kMaxDepth + kQuadLevels);
    for_each_quad(tiles, [&](TileBlocks& tile, int row, int column) { note(tile, row, column); });
    for (auto level = static_cast<int>(by_level_.size()) - 1; level >= 0; --level) {
        // What is raised is of a lower level: it does not come into this list.
        auto& places = by_level_[static_cast<std::size_t>(level)];
        for (const Place& place : places) {
            const TileBlocks& tile = *place.tile;
            const BlockChoice& choice = tile.choices[tile.tree.at(place.row, place.column)];
            if (planet_level(tile, choice) == level) raise_around(place, level);
        }
        places.clear();
    }
    for_each_quad(tiles, set_border_type);
}

}  // namespace eyepoint::terrain::hyperblock
