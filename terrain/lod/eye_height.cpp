#include "terrain/lod/eye_height.hpp"

#include <algorithm>
#include <cmath>

#include "terrain/geodesy/earth.hpp"
#include "terrain/lod/error_level.hpp"

namespace eyepoint::terrain {

namespace {

/// The deepest tile of the database that is loaded with its siblings, and so are its ancestors.
const TileNode& deepest_loaded(TileTree& tree, double latitude_deg, double longitude_deg) {
    const TileNode* node = &tree.roots()[tile_at(latitude_deg, longitude_deg, 0).x];
    while (node->children && node->info.has_children &&
           std::all_of(node->children->begin(), node->children->end(),
                       [](const TileNode& child) { return child.block != nullptr; })) {
        const TileId below = tile_at(latitude_deg, longitude_deg, node->tile.depth + 1);
        node = &(*node->children)[static_cast<std::size_t>(quadrant(below))];
    }
    return *node;
}

/// The highest of the four posts of a leaf about a place: the surface between them is nowhere higher.
double highest_about_m(const BlockData& data, double latitude_deg, double longitude_deg) {
    const double spacing_deg = post_spacing_deg(data.tile.depth);
    const auto before = [&](double degrees) {
        return std::clamp(static_cast<int>(std::floor(degrees / spacing_deg)), 0, kBlockCells - 1);
    };
    const int row = before(latitude_deg - post_latitude_deg(data.tile, 0));
    const int column = before(longitude_deg - post_longitude_deg(data.tile, 0));
    return double{std::max({data.height_m(row, column), data.height_m(row, column + 1),
                            data.height_m(row + 1, column), data.height_m(row + 1, column + 1)})};
}

}  // namespace

double least_height_above_ground_m(TileTree& tree, const Ecef& eye) {
    const Geodetic place = to_geodetic(eye);
    const TileNode& node = deepest_loaded(tree, place.latitude_deg, place.longitude_deg);
    const bool leaf = !node.info.has_children && node.block != nullptr;
    const double highest_m = leaf ? highest_about_m(node.block->data, place.latitude_deg, place.longitude_deg)
                                  : double{node.info.height_max_m};
    return place.height.metres() - highest_m - 2.0 * level_error_m(node.info.first_level);
}

}  // namespace eyepoint::terrain
