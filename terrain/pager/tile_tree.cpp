#include "terrain/pager/tile_tree.hpp"

#include <algorithm>

#include "terrain/database/virtual_tile.hpp"
#include "terrain/geodesy/earth.hpp"

namespace eyepoint::terrain {

namespace {

bool has_finer_picture(const Database& database, TileId tile) {
    if (tile.depth >= kMaxDepth) return false;
    for (int quadrant = 0; quadrant < 4; ++quadrant) {
        const NodeInfo* info = database.find(child(tile, quadrant));
        if (info != nullptr && info->has_image) return true;
    }
    return false;
}

}  // namespace

TileTree::TileTree(std::shared_ptr<const Database> database, MeshKind mesh)
    : database_(std::move(database)), mesh_(mesh) {
    for (std::uint32_t x = 0; x < roots_.size(); ++x) {
        describe(roots_[x], {0, x, 0}, nullptr);
        lowest_height_m_ = std::min(lowest_height_m_, static_cast<double>(roots_[x].info.height_min_m));
    }
}

void TileTree::describe(TileNode& node, TileId tile, TileNode* parent) const {
    node.tile = tile;
    node.parent = parent;
    if (const NodeInfo* info = database_->find(tile)) {
        node.stored = true;
        node.info = *info;
        if (has_finer_picture(*database_, tile)) {
            node.texel_to_refine_m = tile_side_deg(tile.depth) / kImageTexels * kMetresPerDegree;
        }
    } else if (parent != nullptr) {  // roots are always in the database
        node.info = subdivide(parent->info, tile);
    }
    node.bounds = tile_bounds(tile, node.info.height_min_m, node.info.height_max_m);
}

bool TileTree::ends_at(const TileNode& node) const {
    if (node.tile.depth >= kMaxDepth) return true;
    if (mesh_ == MeshKind::Nested) return !node.info.has_children && node.info.first_level == 0;
    return node.tile.depth >= database_->manifest().max_depth + kMaxInterpolatedDepths;
}

std::span<TileNode> TileTree::children(TileNode& node) {
    if (!node.children) {
        if (ends_at(node)) return {};
        node.children = std::make_unique<std::array<TileNode, 4>>();
        for (int quadrant = 0; quadrant < 4; ++quadrant) {
            describe((*node.children)[static_cast<std::size_t>(quadrant)], child(node.tile, quadrant), &node);
        }
    }
    return *node.children;
}

TileNode* TileTree::find(TileId tile) {
    TileNode* node = &roots_[ancestor(tile, 0).x];
    while (node->tile.depth < tile.depth) {
        if (!node->children) return nullptr;
        node = &(*node->children)[static_cast<std::size_t>(quadrant(ancestor(tile, node->tile.depth + 1)))];
    }
    return node;
}

}  // namespace eyepoint::terrain
