#include "tools/terrain/nest/nest.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <map>
#include <mutex>
#include <optional>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "terrain/block/block.hpp"
#include "terrain/database/whole_grid.hpp"
#include "terrain/lod/error_level.hpp"
#include "tools/terrain/nest/collapse.hpp"
#include "tools/terrain/nest/edge_lines.hpp"
#include "tools/terrain/nest/first_levels.hpp"
#include "tools/terrain/nest/sampled_surface.hpp"

namespace eyepoint::tools {

using namespace terrain;

namespace {

constexpr std::int64_t kSide = kPlaceUnits;
/// Of the error of a tile's first level, what full-resolution posts between the samples may take.
constexpr float kBetweenShare = 0.25F;
constexpr std::int64_t kPostSpacing = kSide / kBlockCells;

/// What a tile hands to its parent.
struct Below {
    TriangleMesh coarsest;
    std::vector<MeshGuard> guards;  ///< whose ends are still there, on the tile's edge
    HeightSamples samples;
};

TriangleMesh whole_grid(const BlockData& block) {
    TriangleMesh mesh;
    for (int row = 0; row < kBlockPosts; ++row) {
        for (int column = 0; column < kBlockPosts; ++column)
            mesh.vertices.push_back({column * kPostSpacing, row * kPostSpacing, block.height_m(row, column)});
    }
    const auto triangles = whole_grid_triangles();
    for (std::size_t i = 0; i < triangles.size(); i += 3)
        mesh.triangles.push_back({triangles[i], triangles[i + 1], triangles[i + 2]});
    return mesh;
}

HeightSamples posts_of(const BlockData& block) {
    HeightSamples samples;
    samples.side = kBlockPosts;
    for (int row = 0; row < kBlockPosts; ++row) {
        for (int column = 0; column < kBlockPosts; ++column)
            samples.heights_m.push_back(block.height_m(row, column));
    }
    samples.between_m.assign(samples.heights_m.size(), 0.0F);
    return samples;
}

bool is_own_post(const MeshVertex& vertex) {
    return vertex.x % kPostSpacing == 0 && vertex.y % kPostSpacing == 0;
}

/// Own posts first, in grid order, then finer ones from the south-west: NestedMesh's order.
bool comes_before(const MeshVertex& a, const MeshVertex& b) {
    const bool own_a = is_own_post(a), own_b = is_own_post(b);
    return std::tuple{!own_a, a.y, a.x} < std::tuple{!own_b, b.y, b.x};
}

/// The children's coarsest meshes as one, in the parent's places.
TriangleMesh joined(const std::array<Below, 4>& children) {
    std::vector<MeshVertex> vertices;
    const auto in_parent = [](const MeshVertex& vertex, int quadrant) {
        return MeshVertex{(vertex.x + quadrant % 2 * kSide) / 2, (vertex.y + quadrant / 2 * kSide) / 2,
                          vertex.height_m};
    };
    for (int quadrant = 0; quadrant < 4; ++quadrant) {
        for (const MeshVertex& vertex : children[static_cast<std::size_t>(quadrant)].coarsest.vertices)
            vertices.push_back(in_parent(vertex, quadrant));
    }
    std::sort(vertices.begin(), vertices.end(), comes_before);
    const auto same = [](const MeshVertex& a, const MeshVertex& b) { return a.x == b.x && a.y == b.y; };
    vertices.erase(std::unique(vertices.begin(), vertices.end(), same), vertices.end());
    TriangleMesh mesh;
    for (int quadrant = 0; quadrant < 4; ++quadrant) {
        const TriangleMesh& part = children[static_cast<std::size_t>(quadrant)].coarsest;
        std::vector<std::uint16_t> numbers;
        for (const MeshVertex& vertex : part.vertices) {
            const auto found =
                std::lower_bound(vertices.begin(), vertices.end(), in_parent(vertex, quadrant), comes_before);
            numbers.push_back(static_cast<std::uint16_t>(found - vertices.begin()));
        }
        for (const auto& triangle : part.triangles)
            mesh.triangles.push_back({numbers[triangle[0]], numbers[triangle[1]], numbers[triangle[2]]});
    }
    mesh.vertices = std::move(vertices);
    return mesh;
}

/// The children's guards, in the parent's places, whose ends are on the parent's edge too.
std::vector<MeshGuard> joined_guards(const std::array<Below, 4>& children) {
    std::vector<MeshGuard> guards;
    for (std::int64_t quadrant = 0; quadrant < 4; ++quadrant) {
        const std::int64_t west = quadrant % 2 * kSide, south = quadrant / 2 * kSide;
        for (const MeshGuard& guard : children[static_cast<std::size_t>(quadrant)].guards) {
            const MeshGuard in_parent{(guard.x + west) / 2, (guard.y + south) / 2, (guard.end_x + west) / 2,
                                      (guard.end_y + south) / 2};
            if (in_parent.end_x % kSide == 0 || in_parent.end_y % kSide == 0) guards.push_back(in_parent);
        }
    }
    return guards;
}

std::vector<std::uint16_t> waits(const TriangleMesh& mesh, const std::vector<MeshGuard>& guards) {
    std::map<std::pair<std::int64_t, std::int64_t>, std::uint16_t> numbers;
    std::vector<std::uint16_t> waits;
    for (const MeshVertex& vertex : mesh.vertices) {
        waits.push_back(static_cast<std::uint16_t>(waits.size()));
        numbers[{vertex.x, vertex.y}] = waits.back();
    }
    for (const MeshGuard& guard : guards) {
        const auto vertex = numbers.find({guard.x, guard.y}), end = numbers.find({guard.end_x, guard.end_y});
        if (vertex != numbers.end() && end != numbers.end()) waits[vertex->second] = end->second;
    }
    return waits;
}

std::vector<EdgeFate> edge_fates(TileId tile, const TriangleMesh& mesh, const EdgeLines& lines) {
    std::vector<EdgeFate> fates(mesh.vertices.size());
    for (const Edge edge : kEdges) {
        const bool along_x = edge == Edge::South || edge == Edge::North;
        const std::int64_t fixed = edge == Edge::South || edge == Edge::West ? 0 : kSide;
        const auto line = lines.line(tile, edge);
        const std::int64_t start = edge_start(tile, edge);
        for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
            const MeshVertex& vertex = mesh.vertices[v];
            if ((along_x ? vertex.y : vertex.x) != fixed) continue;
            EdgeFate& fate = fates[v];
            fate.on_edge = true;
            const std::int64_t along = along_x ? vertex.x : vertex.y;
            auto at = EdgeLines::vertex_at(line, tile, edge,
                                           static_cast<std::uint32_t>(start + (along >> tile.depth)));
            while (at.gone_level != NestedMesh::kStays) {
                const std::uint8_t level = at.gone_level;
                at = EdgeLines::vertex_at(line, tile, edge, at.target_at);
                const std::int64_t place = (std::int64_t{at.at} - start) * (std::int64_t{1} << tile.depth);
                fate.steps.push_back(
                    {level, {along_x ? place : fixed, along_x ? fixed : place, at.height_m}});
            }
        }
    }
    return fates;
}

/// Interpolated posts of a line have no height there: the tile's own vertex at the place has.
void take_heights(std::vector<EdgeFate>& fates, const TriangleMesh& mesh) {
    std::map<std::pair<std::int64_t, std::int64_t>, float> heights;
    for (std::size_t v = 0; v < fates.size(); ++v) {
        if (fates[v].on_edge) heights[{mesh.vertices[v].x, mesh.vertices[v].y}] = mesh.vertices[v].height_m;
    }
    for (EdgeFate& fate : fates) {
        for (EdgeFate::Step& step : fate.steps) {
            if (const auto found = heights.find({step.place.x, step.place.y}); found != heights.end())
                step.place.height_m = found->second;
        }
    }
}

class Nesting {
  public:
    Nesting(const Database& heights, const FirstLevels& levels, const EdgeLines& lines,
            const std::function<tl::expected<void, std::string>(const NestedTile&)>& put)
        : heights_(heights), levels_(levels), lines_(lines), put_(put) {}

    /// Empty when the run has stopped.
    std::optional<Below> make(TileId tile, int last_level) {
        if (stopped_) return std::nullopt;
        const auto block = heights_.read_block(tile);
        if (!block) return stop(block.error());
        NodeInfo info = *heights_.find(tile);
        info.first_level = levels_.at(tile);
        info.last_level = static_cast<std::uint8_t>(last_level);

        CollapseRequest request{tile, info.first_level, info.last_level, {}, {}, {}};
        Below below;
        std::vector<MeshGuard> guards;
        if (info.has_children) {
            auto parts = make_children(tile);
            if (!parts) return std::nullopt;
            guards = joined_guards(*parts);
            for (const MeshGuard& guard : lines_.guards(tile)) guards.push_back(guard);
            request.mesh = joined(*parts);
            below.samples =
                HeightSamples::join({std::move((*parts)[0].samples), std::move((*parts)[1].samples),
                                     std::move((*parts)[2].samples), std::move((*parts)[3].samples)},
                                    kBetweenShare * static_cast<float>(level_error_m(info.first_level)));
        } else {
            request.mesh = whole_grid(*block);
            below.samples = posts_of(*block);
        }
        if (request.mesh.vertices.size() > kBlockVertices)
            return stop(fmt::format("tile {}/{}-{} needs {} vertices where {} may be", tile.depth, tile.x,
                                    tile.y, request.mesh.vertices.size(), kBlockVertices));
        request.fates = edge_fates(tile, request.mesh, lines_);
        take_heights(request.fates, request.mesh);
        request.waits_for = waits(request.mesh, guards);
        const CollapseResult result = collapse(request, SampledSurface{tile, below.samples});
        if (auto done = put_({info, *block, nested_mesh(request, result, !info.has_children)}); !done)
            return stop(done.error());
        below.coarsest = coarsest(request.mesh, result);
        below.guards = std::move(guards);
        return below;
    }

    tl::expected<void, std::string> outcome() const {
        if (!failure_.empty()) return tl::unexpected(failure_);
        return {};
    }

  private:
    std::optional<std::array<Below, 4>> make_children(TileId tile) {
        std::array<std::optional<Below>, 4> parts;
        tbb::parallel_for(std::size_t{0}, std::size_t{4}, [&](std::size_t i) {
            parts[i] = make(child(tile, static_cast<int>(i)), levels_.at(tile));
        });
        std::array<Below, 4> whole;
        for (std::size_t i = 0; i < 4; ++i) {
            if (!parts[i]) return std::nullopt;
            whole[i] = std::move(*parts[i]);
        }
        return whole;
    }

    static NestedMesh nested_mesh(const CollapseRequest& request, const CollapseResult& result,
                                  bool whole_grid) {
        NestedMesh mesh;
        mesh.whole_grid = whole_grid;
        mesh.gone_level = result.gone_level;
        mesh.target = result.target;
        if (whole_grid) return mesh;
        for (const MeshVertex& vertex : request.mesh.vertices) {
            if (is_own_post(vertex)) {
                mesh.posts.push_back(static_cast<std::uint16_t>(vertex.y / kPostSpacing * kBlockPosts +
                                                                vertex.x / kPostSpacing));
            } else {
                mesh.fine_posts.push_back({static_cast<std::uint32_t>(vertex.x),
                                           static_cast<std::uint32_t>(vertex.y), vertex.height_m});
            }
        }
        for (const auto& triangle : request.mesh.triangles)
            mesh.triangles.insert(mesh.triangles.end(), triangle.begin(), triangle.end());
        return mesh;
    }

    static TriangleMesh coarsest(const TriangleMesh& mesh, const CollapseResult& result) {
        TriangleMesh coarse;
        std::vector<std::uint16_t> numbers(mesh.vertices.size());
        for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
            if (result.gone_level[v] != NestedMesh::kStays) continue;
            numbers[v] = static_cast<std::uint16_t>(coarse.vertices.size());
            coarse.vertices.push_back(mesh.vertices[v]);
        }
        for (const auto& triangle : result.coarsest)
            coarse.triangles.push_back({numbers[triangle[0]], numbers[triangle[1]], numbers[triangle[2]]});
        return coarse;
    }

    std::nullopt_t stop(std::string reason) {
        const std::scoped_lock lock(mutex_);
        if (failure_.empty()) failure_ = std::move(reason);
        stopped_ = true;
        return std::nullopt;
    }

    const Database& heights_;
    const FirstLevels& levels_;
    const EdgeLines& lines_;
    const std::function<tl::expected<void, std::string>(const NestedTile&)>& put_;
    std::atomic<bool> stopped_ = false;
    std::mutex mutex_;
    std::string failure_;
};

}  // namespace

tl::expected<void, std::string> make_nested_meshes(
    const Database& heights,
    const std::function<tl::expected<void, std::string>(const NestedTile& tile)>& put) {
    const auto levels = first_levels(heights);
    if (!levels) return tl::unexpected(levels.error());
    const auto lines = EdgeLines::make(heights, *levels);
    if (!lines) return tl::unexpected(lines.error());
    Nesting nesting{heights, *levels, *lines, put};
    tbb::parallel_for(0U, 2U, [&](std::uint32_t x) { (void)nesting.make({0, x, 0}, kLastLevel); });
    return nesting.outcome();
}

}  // namespace eyepoint::tools
