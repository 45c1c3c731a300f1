#include "tools/bench/measure/full_surface.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>

#include "terrain/geodesy/earth.hpp"

namespace eyepoint::tools {

namespace {

using terrain::Ecef;
using terrain::EllipsoidalHeight;
using terrain::TileId;

/// Where the vertical through a place meets the Earth's axis: so far below the place's ellipsoid point.
double distance_to_axis_m(double latitude_deg) {
    constexpr double kEccentricity2 = terrain::kFlattening * (2.0 - terrain::kFlattening);
    const double sine = std::sin(latitude_deg * 3.14159265358979323846 / 180.0);
    return terrain::kEquatorialRadiusM / std::sqrt(1.0 - kEccentricity2 * sine * sine);
}

/// A millimetre, or a 2^24th of a large tile, a 2^20th of a small one: vertices may lie 30 tiles and 300 km
/// away (post_error.cpp, kMapLimit), in small tiles 500 tiles.
double map_unit_m(TileId tile) {
    constexpr double kMetresPerDegree = 111000.0, kMillimetre = 1.0 / 1024.0;
    const double side_m = terrain::tile_side_deg(tile.depth) * kMetresPerDegree;
    return std::min(side_m / (1 << 20), std::max(side_m / (1 << 24), kMillimetre));
}

PostTile::Place place_of(const PostTile& tile, const Ecef& post) {
    const glm::dvec3 local = tile.in_frame(post - tile.origin, tile.origin);
    const double scale = tile.centre_below_m / (local.z + tile.centre_below_m) / tile.unit_m;
    return {static_cast<std::int32_t>(std::lround(local.x * scale)),
            static_cast<std::int32_t>(std::lround(local.y * scale)), static_cast<float>(local.x),
            static_cast<float>(local.y), static_cast<float>(local.z)};
}

void note_spans(PostTile& tile) {
    for (std::size_t i = 0; i < PostTile::kSide; ++i) {
        PostTile::Span& row = tile.rows_v[i];
        PostTile::Span& column = tile.columns_u[i];
        row = {tile.posts[i * PostTile::kSide].v, tile.posts[i * PostTile::kSide].v};
        column = {tile.posts[i].u, tile.posts[i].u};
        for (std::size_t k = 0; k < PostTile::kSide; ++k) {
            const PostTile::Place& in_row = tile.posts[i * PostTile::kSide + k];
            const PostTile::Place& in_column = tile.posts[k * PostTile::kSide + i];
            row = {std::min(row.low, in_row.v), std::max(row.high, in_row.v)};
            column = {std::min(column.low, in_column.u), std::max(column.high, in_column.u)};
        }
    }
}

}  // namespace

PostTile lay_out(const terrain::BlockData& block, bool shared_north, bool shared_east) {
    PostTile result;
    result.tile = block.tile;
    const auto area = extent(block.tile);
    const double latitude_deg = (area.south_deg + area.north_deg) / 2.0,
                 longitude_deg = (area.west_deg + area.east_deg) / 2.0;
    // At the height of the middle post, so that what is kept as float is small.
    const double height_m = block.height_m(terrain::kBlockCells / 2, terrain::kBlockCells / 2);
    result.origin = terrain::to_ecef({latitude_deg, longitude_deg, EllipsoidalHeight{height_m}});
    result.axes = terrain::east_north_up(latitude_deg, longitude_deg);
    result.centre_below_m = distance_to_axis_m(latitude_deg) + height_m;
    result.unit_m = map_unit_m(block.tile);
    const bool south_pole = block.tile.y == 0,
               north_pole = block.tile.y + 1 == terrain::tiles_up(block.tile.depth);
    result.first_row = south_pole ? 1 : 0;
    result.end_row = PostTile::kSide - (shared_north || north_pole ? 1 : 0);
    result.end_column = PostTile::kSide - (shared_east ? 1 : 0);
    result.posts.reserve(terrain::kBlockPosts * terrain::kBlockPosts);
    for (int row = 0; row < PostTile::kSide; ++row) {
        for (int column = 0; column < PostTile::kSide; ++column) {
            const Ecef post =
                terrain::to_ecef({post_latitude_deg(block.tile, row), post_longitude_deg(block.tile, column),
                                  EllipsoidalHeight{block.height_m(row, column)}});
            result.posts.push_back(place_of(result, post));
        }
    }
    note_spans(result);
    return result;
}

FullSurface::FullSurface(std::shared_ptr<const terrain::Database> database) : database_(std::move(database)) {
    const auto add = [&](TileId tile, std::int32_t parent) {
        Node& node = nodes_.emplace_back();
        node.tile = tile;
        node.parent = parent;
    };
    add({0, 0, 0}, -1);
    add({0, 1, 0}, -1);
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
        const TileId tile = nodes_[i].tile;
        const terrain::NodeInfo* info = database_->find(tile);
        lowest_height_m_ = std::min<double>(lowest_height_m_, info->height_min_m);
        if (!info->has_children) continue;
        nodes_[i].first_child = static_cast<std::int32_t>(nodes_.size());
        for (int quadrant = 0; quadrant < 4; ++quadrant)
            add(child(tile, quadrant), static_cast<std::int32_t>(i));
    }
}

void FullSurface::see(std::size_t index, const PostView& view, const terrain::HorizonOccluder& horizon,
                      std::vector<std::size_t>& leaves) {
    Node& node = nodes_[index];
    if (!node.bounds_known) {
        const terrain::NodeInfo& info = *database_->find(node.tile);
        node.bounds = terrain::tile_bounds(node.tile, info.height_min_m, info.height_max_m);
        node.bounds_known = true;
    }
    const auto beyond = [&](const glm::dvec3& side) { return outside(node.bounds, view.lod.eye, side); };
    if (std::any_of(view.lod.sides.begin(), view.lod.sides.end(), beyond)) return;
    if (distance_m(node.bounds, view.lod.eye) > view.far_m || horizon.hides(node.bounds)) return;
    node.seen = looks_;
    node.slot = -1;
    if (node.first_child < 0) {
        leaves.push_back(index);
        return;
    }
    const auto first = static_cast<std::size_t>(node.first_child);
    for (std::size_t i = 0; i < 4; ++i) see(first + i, view, horizon, leaves);
}

tl::expected<std::shared_ptr<const PostTile>, std::string> FullSurface::read(TileId tile) const {
    const auto block = database_->read_block(tile);
    if (!block) return tl::unexpected(block.error());
    const auto as_deep = [&](terrain::Edge edge) {
        const auto beside = neighbour(tile, edge);
        return beside && database_->find(*beside) != nullptr;
    };
    return std::make_shared<const PostTile>(
        lay_out(*block, as_deep(terrain::Edge::North), as_deep(terrain::Edge::East)));
}

tl::expected<std::vector<std::shared_ptr<const PostTile>>, std::string> FullSurface::look(
    const PostView& view) {
    ++looks_;
    std::vector<std::size_t> leaves;
    const terrain::HorizonOccluder horizon(view.lod.eye, lowest_height_m_);
    for (std::size_t root = 0; root < 2; ++root) see(root, view, horizon, leaves);

    std::vector<tl::expected<std::shared_ptr<const PostTile>, std::string>> found(leaves.size());
    tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t i) {
        const auto kept = tiles_.find(leaves[i]);
        found[i] = kept != tiles_.end() ? kept->second : read(nodes_[leaves[i]].tile);
    });
    std::vector<std::shared_ptr<const PostTile>> result;
    for (std::size_t i = 0; i < leaves.size(); ++i) {
        if (!found[i]) return tl::unexpected(found[i].error());
        nodes_[leaves[i]].slot = static_cast<std::int32_t>(i);
        tiles_.try_emplace(leaves[i], *found[i]);
        result.push_back(*found[i]);
    }
    if (tiles_.size() > kMostTilesKept) forget_unseen();
    return result;
}

void FullSurface::forget_unseen() {
    std::erase_if(tiles_, [&](const auto& entry) { return nodes_[entry.first].seen != looks_; });
}

std::size_t FullSurface::node_of(TileId tile) const {
    std::size_t node = ancestor(tile, 0).x;
    while (nodes_[node].first_child >= 0 && nodes_[node].tile.depth < tile.depth) {
        const TileId below = ancestor(tile, nodes_[node].tile.depth + 1);
        node = static_cast<std::size_t>(nodes_[node].first_child + quadrant(below));
    }
    return node;
}

}  // namespace eyepoint::tools
