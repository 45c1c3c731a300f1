#include <algorithm>

#include "terrain/block/block.hpp"
#include "terrain/block/block_vertex.hpp"
#include "terrain/database/mesh_places.hpp"
#include "terrain/database/whole_grid.hpp"

namespace eyepoint::terrain {

namespace {

constexpr std::int64_t kCellUnits = kPlaceUnits / std::uint32_t{kMeshCells};
constexpr std::size_t kCells = std::size_t{kMeshCells} * kMeshCells;

/// Order of NestedMesh::fine_posts.
bool before(const NestedMesh::FinePost& post, Place place) {
    const Place at = place_of(post);
    return at.y != place.y ? at.y < place.y : at.x < place.x;
}

/// Finds the vertices of a block by their places.
class VertexFinder {
  public:
    explicit VertexFinder(const Block& block) : block_(block) {
        at_post_.fill(kNoVertex);
        own_posts_ = block.vertices.size() - block.fine_posts.size();
        constexpr std::uint32_t kUnits = kVertexPlaceUnits / std::uint32_t{kBlockCells};
        for (std::size_t i = 0; i < own_posts_; ++i) {
            const std::uint32_t place = block.vertices[i].place;
            at_post_[(place >> 16) / kUnits * kBlockPosts + (place & 0xffffU) / kUnits] =
                static_cast<std::uint16_t>(i);
        }
    }

    [[nodiscard]] std::uint32_t at(Place place) const {
        if (place.x % kPostUnits == 0 && place.y % kPostUnits == 0)
            return at_post_[static_cast<std::size_t>(place.y / kPostUnits * kBlockPosts +
                                                     place.x / kPostUnits)];
        const auto& posts = block_.fine_posts;
        const auto found = std::lower_bound(posts.begin(), posts.end(), place, before);
        if (found == posts.end() || place_of(*found).x != place.x || place_of(*found).y != place.y)
            return kNoVertex;
        return static_cast<std::uint32_t>(own_posts_ + static_cast<std::size_t>(found - posts.begin()));
    }

  private:
    const Block& block_;
    std::array<std::uint16_t, kBlockVertices> at_post_{};
    std::size_t own_posts_ = 0;
};

/// Where a place of a child lies in its parent.
Place in_parent(Place place, TileId child) {
    constexpr std::int32_t kHalf = kPlaceUnits / 2;
    return {place.x / 2 + ((child.x & 1U) != 0 ? kHalf : 0), place.y / 2 + ((child.y & 1U) != 0 ? kHalf : 0)};
}

std::vector<BlockVertex> positioned(const BlockData& data, const NestedMesh& mesh) {
    VertexMaker maker(data);
    std::vector<BlockVertex> vertices;
    vertices.reserve(mesh.vertices());
    for (int post = 0; mesh.whole_grid && post < kBlockVertices; ++post)
        vertices.push_back(maker.at_post(post / kBlockPosts, post % kBlockPosts));
    for (const std::uint16_t post : mesh.posts)
        vertices.push_back(maker.at_post(post / kBlockPosts, post % kBlockPosts));
    for (const auto& post : mesh.fine_posts) vertices.push_back(maker.at_fine_post(post));
    return vertices;
}

void set_motion(Block& block, const NestedMesh& mesh, std::span<const Place> places, const Block* parent) {
    std::optional<VertexFinder> finder;
    if (parent != nullptr) finder.emplace(*parent);
    for (std::size_t i = 0; i < block.vertices.size(); ++i) {
        BlockVertex& vertex = block.vertices[i];
        const bool stays = mesh.gone_level[i] == NestedMesh::kStays;
        std::uint32_t next = mesh.target[i];
        if (stays) next = finder ? finder->at(in_parent(places[i], block.data.tile)) : kNoVertex;
        vertex.set_motion(next, mesh.gone_level[i]);
    }
}

using Triangle = std::array<std::uint16_t, 3>;

std::vector<Triangle> first_triangles(const NestedMesh& mesh) {
    const std::span<const std::uint16_t> indices =
        mesh.whole_grid ? whole_grid_triangles() : std::span<const std::uint16_t>{mesh.triangles};
    std::vector<Triangle> triangles;
    triangles.reserve(indices.size() / 3);
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3)
        triangles.push_back({indices[i], indices[i + 1], indices[i + 2]});
    return triangles;
}

std::size_t cell_of(const Triangle& triangle, std::span<const Place> places) {
    std::int64_t x = 0, y = 0;
    for (const std::uint16_t corner : triangle) {
        x += places[corner].x;
        y += places[corner].y;
    }
    constexpr std::int64_t kLast = kMeshCells - 1;
    return static_cast<std::size_t>(std::min(y / (3 * kCellUnits), kLast) * kMeshCells +
                                    std::min(x / (3 * kCellUnits), kLast));
}

/// The first level's triangles in the order of their cells, and where each cell begins.
struct SortedTriangles {
    std::vector<Triangle> triangles;
    std::array<std::uint32_t, kCells + 1> cell_first{};
};

SortedTriangles sorted_by_cell(const std::vector<Triangle>& triangles, std::span<const Place> places) {
    SortedTriangles sorted;
    std::vector<std::uint8_t> cells;
    cells.reserve(triangles.size());
    for (const Triangle& triangle : triangles) {
        cells.push_back(static_cast<std::uint8_t>(cell_of(triangle, places)));
        ++sorted.cell_first[cells.back() + std::size_t{1}];
    }
    for (std::size_t cell = 0; cell < kCells; ++cell) sorted.cell_first[cell + 1] += sorted.cell_first[cell];
    auto next = sorted.cell_first;
    sorted.triangles.resize(triangles.size());
    for (std::size_t i = 0; i < triangles.size(); ++i) sorted.triangles[next[cells[i]]++] = triangles[i];
    return sorted;
}

/// Appends to the index list the triangles of one level, made from those of the level before (corner(i) is
/// their i-th corner), and says where its cells begin.
template <typename Corner>
NestedLevel append_level(std::vector<std::uint16_t>& indices,
                         const std::array<std::uint32_t, kCells + 1>& from, const NestedMesh& mesh, int level,
                         Corner corner) {
    const auto standing = [&](std::uint16_t vertex) {
        while (mesh.gone_level[vertex] <= level) vertex = mesh.target[vertex];
        return vertex;
    };
    NestedLevel result;
    for (std::size_t cell = 0; cell < kCells; ++cell) {
        result.cell_first[cell] = static_cast<std::uint32_t>(indices.size());
        for (std::uint32_t i = from[cell]; i < from[cell + 1]; i += 3) {
            const std::uint16_t a = standing(corner(i)), b = standing(corner(i + 1)),
                                c = standing(corner(i + 2));
            if (a == b || b == c || a == c) continue;
            indices.insert(indices.end(), {a, b, c});
        }
        result.filled |= std::uint64_t{indices.size() > result.cell_first[cell]} << cell;
    }
    result.cell_first[kCells] = static_cast<std::uint32_t>(indices.size());
    return result;
}

/// Every level's list comes from the one before it: a triangle once gone stays away. A level at which no
/// vertex goes has the list of the one before.
void append_levels(Block& block, const NestedMesh& mesh, std::span<const Place> places) {
    SortedTriangles sorted = sorted_by_cell(first_triangles(mesh), places);
    for (std::uint32_t& first : sorted.cell_first) first *= 3;
    std::array<bool, 256> goes_at{};
    for (const std::uint8_t level : mesh.gone_level) goes_at[level] = true;
    block.indices.reserve(sorted.triangles.size() * 3 * 2);
    block.levels.reserve(static_cast<std::size_t>(block.last_level - block.first_level) + 1 +
                         CellBoxes::kLevelsBeyond);
    block.levels.push_back(append_level(block.indices, sorted.cell_first, mesh, block.first_level,
                                        [&](std::uint32_t i) { return sorted.triangles[i / 3][i % 3]; }));
    for (int level = block.first_level + 1; level <= block.last_level; ++level) {
        const NestedLevel before = block.levels.back();
        block.levels.push_back(goes_at[static_cast<std::size_t>(level)]
                                   ? append_level(block.indices, before.cell_first, mesh, level,
                                                  [&](std::uint32_t i) { return block.indices[i]; })
                                   : before);
    }
}

/// Where a vertex that stays has gone to in the parent's mesh by a level.
std::uint32_t standing_in_parent(const Block& parent, const BlockVertex& vertex, int level) {
    std::uint32_t at = vertex.next();
    while (parent.vertices[at].gone_level() <= level) at = parent.vertices[at].next();
    return at;
}

/// Appends those of the last list's triangles that have not slid shut by a level of the parent's.
NestedLevel append_beyond(Block& block, const Block& parent, int level) {
    std::vector<std::uint32_t> standing(block.vertices.size(), kNoVertex);
    const NestedLevel before = block.levels.back();
    for (std::uint32_t i = before.first(); i < before.first() + before.count(); ++i) {
        const std::uint16_t vertex = block.indices[i];
        standing[vertex] = standing_in_parent(parent, block.vertices[vertex], level);
    }
    NestedLevel result;
    for (std::size_t cell = 0; cell < kCells; ++cell) {
        result.cell_first[cell] = static_cast<std::uint32_t>(block.indices.size());
        for (std::uint32_t i = before.cell_first[cell]; i < before.cell_first[cell + 1]; i += 3) {
            const Triangle triangle{block.indices[i], block.indices[i + 1], block.indices[i + 2]};
            const auto &a = standing[triangle[0]], &b = standing[triangle[1]], &c = standing[triangle[2]];
            if (a != b && b != c && a != c)
                block.indices.insert(block.indices.end(), triangle.begin(), triangle.end());
        }
        result.filled |= std::uint64_t{block.indices.size() > result.cell_first[cell]} << cell;
    }
    result.cell_first[kCells] = static_cast<std::uint32_t>(block.indices.size());
    if (result.count() != before.count()) return result;
    block.indices.resize(result.first());
    return before;
}

/// Lists for levels above the last, as far as the parent's mesh and the cells' boxes go.
void append_levels_beyond(Block& block, const Block& parent) {
    const bool all_in_parent =
        std::all_of(block.vertices.begin(), block.vertices.end(), [](const auto& vertex) {
            return vertex.gone_level() != NestedMesh::kStays || vertex.next() != kNoVertex;
        });
    if (!all_in_parent) return;
    for (int level = block.last_level + 1; level <= last_box_level(block, &parent); ++level)
        block.levels.push_back(append_beyond(block, parent, level));
}

}  // namespace

std::shared_ptr<const Block> unfold(BlockData data, const NodeInfo& info, const NestedMesh& mesh,
                                    const Block* parent, std::optional<ImageData> image, bool with_bounds) {
    auto block = std::make_shared<Block>();
    block->data = data;
    block->first_level = info.first_level;
    block->last_level = info.last_level;
    block->vertices = positioned(block->data, mesh);
    block->fine_posts = mesh.fine_posts;
    const std::vector<Place> places = vertex_places(mesh);
    set_motion(*block, mesh, places, parent);
    append_levels(*block, mesh, places);
    if (parent != nullptr) append_levels_beyond(*block, *parent);
    block->indices.shrink_to_fit();
    block->cell_boxes = cell_boxes(*block, parent);
    block->relief = relief_of(block->data);
    block->has_water = std::any_of(block->data.water.begin(), block->data.water.end(),
                                   [](std::uint8_t flag) { return flag != 0; });
    block->image = std::move(image);
    if (with_bounds) block->bounds = std::make_shared<const CellBounds>(cell_bounds(*block, parent));
    return block;
}

}  // namespace eyepoint::terrain
