#include "tests/terrain/lod/nested_mesh.hpp"

#include <algorithm>
#include <bit>
#include <unordered_map>
#include <unordered_set>

#include "terrain/tiling/tile_edges.hpp"

namespace eyepoint::testing {

namespace {

using terrain::BlockDraw;
using terrain::DrawnVertex;
using terrain::Edge;
using terrain::TileId;
using DrawnTiles = std::unordered_set<TileId, terrain::TileHash>;

/// Where a vertex is drawn, and the edges of its tile (bits as in BlockVertex::sides) that it is on,
/// has slid to, or has slid across.
struct Moved {
    PointBits point{};
    unsigned edges = 0;
};

/// All meridians meet at a pole.
unsigned with_meridians_at_pole(TileId tile, unsigned edges) {
    const bool south = (edges & 4U) != 0 && tile.y == 0;
    const bool north = (edges & 8U) != 0 && tile.y + 1 == terrain::tiles_up(tile.depth);
    return south || north ? edges | 3U : edges;
}

Moved moved(const BlockDraw& draw, std::uint16_t vertex, const terrain::MotionView& view) {
    const DrawnVertex drawn = drawn_vertex(*draw.node, vertex, draw.floors, view);
    const unsigned edges = (drawn.place.x <= 0.0F ? 1U : 0U) | (drawn.place.x >= 1.0F ? 2U : 0U) |
                           (drawn.place.y <= 0.0F ? 4U : 0U) | (drawn.place.y >= 1.0F ? 8U : 0U);
    return {bits_of(drawn),
            with_meridians_at_pole(draw.node->tile, edges | draw.node->block->vertices[vertex].sides())};
}

std::vector<Moved> moved_vertices(const BlockDraw& draw, const terrain::MotionView& view) {
    const auto& block = *draw.node->block;
    std::vector<Moved> result(block.vertices.size());
    std::vector<bool> used(block.vertices.size(), false);
    for (std::uint32_t i = 0; i < draw.indices.count; ++i) {
        const std::uint16_t vertex = block.indices[draw.indices.first + i];
        if (!used[vertex]) result[vertex] = moved(draw, vertex, view);
        used[vertex] = true;
    }
    return result;
}

/// Calls visit(draw, three vertices' edges, three points) for every triangle.
template <typename Visit>
void visit_triangles(std::span<const BlockDraw> draws, const terrain::MotionView& view, Visit visit) {
    for (const BlockDraw& draw : draws) {
        const std::vector<Moved> vertices = moved_vertices(draw, view);
        const auto* index = draw.node->block->indices.data() + draw.indices.first;
        for (std::uint32_t i = 0; i < draw.indices.count; i += 3) {
            const Moved &a = vertices[index[i]], &b = vertices[index[i + 1]], &c = vertices[index[i + 2]];
            const std::array<PointBits, 3> corners{a.point, b.point, c.point};
            visit(draw, std::array{a.edges, b.edges, c.edges}, corners);
        }
    }
}

/// Which tiles are drawn.
struct Surroundings {
    DrawnTiles drawn;
    DrawnTiles above_drawn;

    explicit Surroundings(std::span<const BlockDraw> draws) {
        for (const BlockDraw& draw : draws) {
            drawn.insert(draw.node->tile);
            for (TileId tile = draw.node->tile; tile.depth > 0;) {
                tile = terrain::parent(tile);
                above_drawn.insert(tile);
            }
        }
    }
    /// Whether everything in a tile along an edge is drawn.
    [[nodiscard]] bool all_drawn(TileId tile, Edge edge) const {
        for (TileId above = tile; above.depth > 0;) {
            above = terrain::parent(above);
            if (drawn.contains(above)) return true;
        }
        return below_drawn(tile, edge);
    }
    [[nodiscard]] bool below_drawn(TileId tile, Edge edge) const {
        if (drawn.contains(tile)) return true;
        if (!above_drawn.contains(tile)) return false;
        const auto touching = terrain::children_at(edge);
        return std::all_of(touching.begin(), touching.end(), [&](std::size_t quadrant) {
            return below_drawn(terrain::child(tile, static_cast<int>(quadrant)), edge);
        });
    }
    /// Whether one of some edges of a tile has something beyond it that is not drawn.
    [[nodiscard]] bool at_border(const terrain::TileNode& node, unsigned edges) const {
        for (const Edge edge : terrain::kEdges) {
            if ((edges >> static_cast<unsigned>(edge) & 1U) == 0) continue;
            const auto beside = terrain::neighbour(node.tile, edge);
            if (!beside || !all_drawn(*beside, terrain::opposite(edge))) return true;
        }
        return false;
    }
};

bool is_shut(const std::array<PointBits, 3>& corners) {
    return corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0];
}

struct DirectedEdge {
    PointBits from;
    PointBits to;
    bool operator==(const DirectedEdge&) const = default;
};
struct EdgeHash {
    std::size_t operator()(const DirectedEdge& edge) const {
        std::uint64_t bits = 0;
        for (const auto& end : {edge.from, edge.to}) {
            for (const std::uint32_t word : end)
                bits = (bits ^ word) * 0x9e3779b97f4a7c15ULL, bits ^= bits >> 31;
        }
        return bits;
    }
};
struct EdgeUse {
    std::size_t times = 0;
    std::size_t open = 0;  ///< of them: by triangles that are not shut
    bool border = false;   ///< any of them at the border
};

}  // namespace

PointBits bits_of(const DrawnVertex& vertex) {
    return {std::bit_cast<std::uint32_t>(vertex.from_eye.x), std::bit_cast<std::uint32_t>(vertex.from_eye.y),
            std::bit_cast<std::uint32_t>(vertex.from_eye.z)};
}

std::vector<DrawnTriangle> drawn_triangles(std::span<const BlockDraw> draws,
                                           const terrain::MotionView& view) {
    std::vector<DrawnTriangle> triangles;
    visit_triangles(draws, view, [&](const BlockDraw&, const auto&, std::array<PointBits, 3> corners) {
        if (is_shut(corners)) return;
        std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
        triangles.push_back({corners});
    });
    std::sort(triangles.begin(), triangles.end());
    return triangles;
}

NestedFaults find_nested_faults(std::span<const BlockDraw> draws, const terrain::MotionView& view) {
    const Surroundings surroundings(draws);
    std::unordered_map<DirectedEdge, EdgeUse, EdgeHash> edges;
    visit_triangles(draws, view, [&](const BlockDraw& draw, const auto& at_edges, const auto& corners) {
        for (std::size_t i = 0; i < 3; ++i) {
            if (corners[i] == corners[(i + 1) % 3]) continue;
            EdgeUse& use = edges[{corners[i], corners[(i + 1) % 3]}];
            ++use.times;
            use.open += is_shut(corners) ? 0 : 1;
            use.border =
                use.border || surroundings.at_border(*draw.node, at_edges[i] & at_edges[(i + 1) % 3]);
        }
    });
    NestedFaults faults;
    faults.edges = edges.size();
    for (const auto& [edge, use] : edges) {
        if (use.open > 1) ++faults.overlaps;
        const auto back = edges.find({edge.to, edge.from});
        const EdgeUse other = back == edges.end() ? EdgeUse{} : back->second;
        if (!use.border && !other.border && use.times != other.times) ++faults.cracks;
    }
    return faults;
}

std::size_t count_stacked(std::span<const BlockDraw> draws) {
    DrawnTiles drawn;
    for (const BlockDraw& draw : draws) drawn.insert(draw.node->tile);
    std::size_t stacked = 0;
    for (TileId tile : drawn) {
        while (tile.depth > 0) {
            tile = terrain::parent(tile);
            if (drawn.contains(tile)) ++stacked;
        }
    }
    return stacked + (draws.size() - drawn.size());
}

}  // namespace eyepoint::testing
