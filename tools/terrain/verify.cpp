#include "tools/terrain/verify.hpp"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <random>
#include <tuple>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>

#include "terrain/database/interpolate.hpp"
#include "terrain/database/mesh_places.hpp"
#include "terrain/database/mesh_structure.hpp"
#include "terrain/geodesy/earth.hpp"
#include "terrain/lod/error_level.hpp"

namespace eyepoint::tools {

using namespace terrain;

namespace {

std::string name_of(TileId tile) { return fmt::format("tile {}/{}-{}", tile.depth, tile.x, tile.y); }

/// Heights along an edge, from the south or the west.
std::array<float, kBlockPosts> edge_heights(const BlockData& block, Edge edge) {
    std::array<float, kBlockPosts> heights{};
    for (int post = 0; post < kBlockPosts; ++post) {
        float& height = heights[static_cast<std::size_t>(post)];
        switch (edge) {
            case Edge::West:
                height = block.height_m(post, 0);
                break;
            case Edge::East:
                height = block.height_m(post, kBlockCells);
                break;
            case Edge::South:
                height = block.height_m(0, post);
                break;
            case Edge::North:
                height = block.height_m(kBlockCells, post);
                break;
        }
    }
    return heights;
}

/// The vertices of a tile that its parent has too, in the parent's units: what stays of the tile's mesh.
std::vector<std::pair<std::int64_t, std::int64_t>> staying_in_parent(const NestedMesh& mesh, TileId tile) {
    const std::int64_t side{kPlaceUnits};
    const std::int64_t west = quadrant(tile) % 2 * side, south = quadrant(tile) / 2 * side;
    const auto places = vertex_places(mesh);
    std::vector<std::pair<std::int64_t, std::int64_t>> result;
    for (std::size_t vertex = 0; vertex < places.size(); ++vertex) {
        if (mesh.gone_level[vertex] == NestedMesh::kStays)
            result.emplace_back((west + places[vertex].x) / 2, (south + places[vertex].y) / 2);
    }
    std::ranges::sort(result);
    return result;
}

/// The vertices of a parent's mesh that lie in a child or on its edges.
std::vector<std::pair<std::int64_t, std::int64_t>> vertices_in_child(const NestedMesh& mesh, TileId tile) {
    const std::int64_t half = kPlaceUnits / 2;
    const std::int64_t west = quadrant(tile) % 2 * half, south = quadrant(tile) / 2 * half;
    std::vector<std::pair<std::int64_t, std::int64_t>> result;
    for (const Place place : vertex_places(mesh)) {
        if (place.x >= west && place.x <= west + half && place.y >= south && place.y <= south + half)
            result.emplace_back(place.x, place.y);
    }
    std::ranges::sort(result);
    return result;
}

class Verification {
  public:
    Verification(const Database& database, const VerifyRequest& request)
        : database_(database), request_(request) {}

    std::vector<std::string> run() {
        const auto tiles = database_.tiles();
        tbb::parallel_for(std::size_t{0}, tiles.size(), [&](std::size_t i) {
            check_tile(tiles[i]);
            const std::uint64_t done = ++done_;
            if (request_.progress && done % 64 == 0) {
                const std::lock_guard guard{mutex_};
                request_.progress(done, tiles.size());
            }
        });
        if (faults_.empty()) check_deltas();
        return std::move(faults_);
    }

  private:
    void report(std::string fault) {
        const std::lock_guard guard{mutex_};
        faults_.push_back(std::move(fault));
    }

    void check_tile(TileId tile) {
        const auto block = database_.read_block(tile);
        if (!block) return report(block.error());
        const NodeInfo& info = *database_.find(tile);
        if (info.has_image) {
            if (const auto image = database_.read_image(tile); !image) report(image.error());
        }
        check_levels(tile, info);
        check_mesh(tile);
        check_range(*block, info);
        check_poles(*block);
        for (const Edge edge : kEdges) check_edge(*block, edge);
        if (tile.depth > 0) check_parent(*block);
    }

    void check_levels(TileId tile, const NodeInfo& info) {
        if (!info.has_children && info.first_level != bare_level(tile)) {
            report(fmt::format("{}: it has no children and its first level is {}, not {}", name_of(tile),
                               info.first_level, bare_level(tile)));
        }
        const std::uint8_t last = tile.depth == 0 ? kLastLevel : database_.find(parent(tile))->first_level;
        if (info.last_level != last) {
            report(fmt::format("{}: its last level is {}, its parent's first is {}", name_of(tile),
                               info.last_level, last));
        }
    }

    void check_mesh(TileId tile) {
        const auto mesh = database_.read_mesh(tile);
        if (!mesh) return report(mesh.error());
        if (const auto covered = check_cover(*mesh); !covered)
            report(fmt::format("mesh of {}: {}", name_of(tile), covered.error()));
        if (tile.depth == 0) return;
        const auto above = database_.read_mesh(parent(tile));
        if (!above) return;  // reported when its own turn comes
        if (staying_in_parent(*mesh, tile) != vertices_in_child(*above, tile)) {
            report(fmt::format("mesh of {}: what stays of it is not what its parent's mesh has there",
                               name_of(tile)));
        }
    }

    void check_range(const BlockData& block, const NodeInfo& info) {
        for (int row = 0; row < kBlockPosts; ++row) {
            for (int column = 0; column < kBlockPosts; ++column) {
                const float height = block.height_m(row, column);
                if (height >= info.height_min_m && height <= info.height_max_m) continue;
                return report(fmt::format(
                    "{}: height {} m at row {}, column {} is outside the node's range {}..{} m",
                    name_of(block.tile), height, row, column, info.height_min_m, info.height_max_m));
            }
        }
        if (block.tile.depth == 0) return;
        const NodeInfo& above = *database_.find(parent(block.tile));
        if (info.height_min_m < above.height_min_m || info.height_max_m > above.height_max_m) {
            report(fmt::format("{}: its height range is not within its parent's", name_of(block.tile)));
        }
    }

    void check_poles(const BlockData& block) {
        const auto level = [&](Edge edge) {
            const auto heights = edge_heights(block, edge);
            if (std::ranges::all_of(heights, [&](float height) { return height == heights.front(); })) return;
            report(fmt::format("{}: the pole has more than one height", name_of(block.tile)));
        };
        if (block.tile.y == 0) level(Edge::South);
        if (block.tile.y + 1 == tiles_up(block.tile.depth)) level(Edge::North);
    }

    void check_edge(const BlockData& block, Edge edge) {
        const auto beyond = neighbour(block.tile, edge);
        if (!beyond) return;
        const auto ours = edge_heights(block, edge);
        if (database_.find(*beyond) == nullptr) return check_coarser_edge(block.tile, edge, ours);
        if (edge == Edge::West || edge == Edge::South) return;  // the neighbour looks at it
        const auto other = database_.read_block(*beyond);
        if (!other) return;  // reported when its own turn comes
        if (ours != edge_heights(*other, edge == Edge::East ? Edge::West : Edge::South)) {
            report(
                fmt::format("{} and {}: their shared edge differs", name_of(block.tile), name_of(*beyond)));
        }
    }

    void check_coarser_edge(TileId tile, Edge edge, const std::array<float, kBlockPosts>& heights) {
        const double step_m = database_.manifest().height_step_m;
        for (std::size_t post = 1; post < heights.size(); post += 2) {
            const auto between =
                midpoint(to_quanta(heights[post - 1], step_m), to_quanta(heights[post + 1], step_m));
            if (to_quanta(heights[post], step_m) == between) continue;
            return report(fmt::format("{}: post {} of its edge {} is not on the coarser neighbour's edge",
                                      name_of(tile), post, static_cast<int>(edge)));
        }
    }

    void check_parent(const BlockData& block) {
        const auto above = database_.read_block(parent(block.tile));
        if (!above) return;
        const int south = quadrant(block.tile) / 2 * kBlockCells / 2;
        const int west = quadrant(block.tile) % 2 * kBlockCells / 2;
        for (int row = 0; row < kBlockPosts; row += 2) {
            for (int column = 0; column < kBlockPosts; column += 2) {
                if (block.height_m(row, column) == above->height_m(south + row / 2, west + column / 2))
                    continue;
                return report(fmt::format("{}: the height at row {}, column {} is not its parent's",
                                          name_of(block.tile), row, column));
            }
        }
    }

    void check_deltas();
    void check_delta_path(std::mt19937_64& random);
    void check_delta(const BlockData& coarse, const BlockData& leaf, double u, double v);

    const Database& database_;
    const VerifyRequest& request_;
    std::atomic<std::uint64_t> done_ = 0;
    std::mutex mutex_;
    std::vector<std::string> faults_;
};

void Verification::check_deltas() {
    std::mt19937_64 random{request_.seed};
    for (int path = 0; path < request_.delta_paths && faults_.empty(); ++path) check_delta_path(random);
}

void Verification::check_delta_path(std::mt19937_64& random) {
    std::vector<BlockData> path;
    TileId tile{0, static_cast<std::uint32_t>(random() % 2), 0};
    while (true) {
        auto block = database_.read_block(tile);
        if (!block) return report(block.error());
        path.push_back(*block);
        if (!database_.find(tile)->has_children) break;
        // Towards the detail, or every path would end in an ocean.
        std::array<TileId, 4> below{child(tile, 0), child(tile, 1), child(tile, 2), child(tile, 3)};
        std::ranges::shuffle(below, random);
        const auto split =
            std::ranges::find_if(below, [&](TileId t) { return database_.find(t)->has_children; });
        tile = split != below.end() && random() % 8 != 0 ? *split : below[0];
    }
    std::uniform_real_distribution<double> share{0.0, 1.0};
    for (int point = 0; point < 64; ++point) {
        const double u = share(random) * kBlockCells, v = share(random) * kBlockCells;
        for (const BlockData& coarse : path) check_delta(coarse, path.back(), u, v);
    }
}

/// Weights of a cell's corners SW, SE, NW, NE at a place in it, on the triangle south-east or north-west of
/// the diagonal.
std::array<double, 4> corner_weights(double u, double v) {
    if (u >= v) return {1.0 - u, u - v, 0.0, v};
    return {1.0 - v, 0.0, v - u, u};
}

/// u, v: the place in the leaf's cells from its south-west corner.
void Verification::check_delta(const BlockData& coarse, const BlockData& leaf, double u, double v) {
    const auto spacing = post_spacing_deg(leaf.tile.depth);
    const int cu = static_cast<int>(u), cv = static_cast<int>(v);
    const auto fine = corner_weights(u - cu, v - cv);
    double height_m = 0.0;
    for (int i = 0; i < 4; ++i)
        height_m += fine[static_cast<std::size_t>(i)] * leaf.height_m(cv + i / 2, cu + i % 2);
    const auto sides = extent(leaf.tile);
    const Ecef surface =
        to_ecef({sides.south_deg + v * spacing, sides.west_deg + u * spacing, EllipsoidalHeight{height_m}});

    const auto whole = extent(coarse.tile);
    const double posts = tile_side_deg(coarse.tile.depth) / kBlockCells;
    const double x = (sides.west_deg + u * spacing - whole.west_deg) / posts;
    const double y = (sides.south_deg + v * spacing - whole.south_deg) / posts;
    const NodeInfo& info = *database_.find(coarse.tile);
    for (int level = 0; level < kBlockLevels; ++level) {
        const int stride = 1 << level;
        const int column = std::min(static_cast<int>(x) / stride * stride, kBlockCells - stride);
        const int row = std::min(static_cast<int>(y) / stride * stride, kBlockCells - stride);
        const auto weights = corner_weights((x - column) / stride, (y - row) / stride);
        Ecef mesh{0.0};
        for (int i = 0; i < 4; ++i) {
            const int r = row + i / 2 * stride, c = column + i % 2 * stride;
            mesh += weights[static_cast<std::size_t>(i)] *
                    to_ecef({post_latitude_deg(coarse.tile, r), post_longitude_deg(coarse.tile, c),
                             EllipsoidalHeight{coarse.height_m(r, c)}});
        }
        const double away_m = glm::distance(surface, mesh);
        if (away_m <= info.delta_m[static_cast<std::size_t>(level)]) continue;
        report(fmt::format("{}: the surface is {:.4f} m from level {}, above its delta of {:.4f} m",
                           name_of(coarse.tile), away_m, level,
                           info.delta_m[static_cast<std::size_t>(level)]));
    }
}

}  // namespace

std::vector<std::string> verify(const Database& database, const VerifyRequest& request) {
    return Verification{database, request}.run();
}

}  // namespace eyepoint::tools
