#include "tests/terrain/lod/drawn_mesh.hpp"

#include <algorithm>
#include <array>
#include <bitset>
#include <cstring>
#include <unordered_set>
#include <vector>

namespace eyepoint::testing {

namespace {

using terrain::BlockDraw;
using terrain::TileId;
using DrawnTiles = std::unordered_set<TileId, terrain::TileHash>;

/// Posts are numbered on the lattice of the deepest depth drawn; longitude wraps.
struct Lattice {
    std::uint32_t depth = 0;

    [[nodiscard]] std::int64_t around() const {
        return std::int64_t{terrain::tiles_across(depth)} * terrain::kBlockCells;
    }
    [[nodiscard]] std::array<std::int64_t, 2> post(TileId tile, int index) const {
        const std::int64_t step = std::int64_t{1} << (depth - tile.depth);
        const std::int64_t row = std::int64_t{tile.y} * terrain::kBlockCells + index / terrain::kBlockPosts;
        const std::int64_t column =
            std::int64_t{tile.x} * terrain::kBlockCells + index % terrain::kBlockPosts;
        return {row * step, column * step};
    }
    [[nodiscard]] std::uint64_t name(std::array<std::int64_t, 2> post) const {
        return (static_cast<std::uint64_t>(post[0]) << 32) | static_cast<std::uint64_t>(post[1] % around());
    }
};

/// A triangle's edge, the triangle on its left.
struct LatticeEdge {
    std::array<std::uint64_t, 2> ends{};  ///< names, the smaller first: equal for both sides of a shared edge
    bool forward = true;                  ///< from the smaller name to the larger
    std::array<std::int64_t, 2> a{};
    std::array<std::int64_t, 2> b{};
};

LatticeEdge make_edge(const Lattice& lattice, std::array<std::int64_t, 2> a, std::array<std::int64_t, 2> b) {
    const std::uint64_t from = lattice.name(a), to = lattice.name(b);
    return {{std::min(from, to), std::max(from, to)}, from < to, a, b};
}

/// A post as one draw uses it.
struct PostUse {
    std::uint64_t name = 0;
    const terrain::BlockVertex* vertex = nullptr;
};

bool same_bits(const terrain::BlockVertex& a, const terrain::BlockVertex& b) {
    return std::memcmp(a.high.data(), b.high.data(), sizeof(a.high)) == 0 &&
           std::memcmp(a.low.data(), b.low.data(), sizeof(a.low)) == 0;
}

/// Whether the place just across an edge (its triangle lies on its left, the place on its right) is in a
/// drawn tile.
bool drawn_across(const LatticeEdge& edge, const Lattice& lattice, const DrawnTiles& drawn) {
    const std::int64_t d_row = edge.b[0] - edge.a[0], d_column = edge.b[1] - edge.a[1];
    // Middle of the edge in half steps, moved half a step to the right of its direction.
    const std::int64_t row2 = edge.a[0] + edge.b[0] + (d_column > 0 ? -1 : d_column < 0 ? 1 : 0);
    std::int64_t column2 = edge.a[1] + edge.b[1] + (d_row > 0 ? 1 : d_row < 0 ? -1 : 0);
    const std::int64_t up2 = std::int64_t{terrain::tiles_up(lattice.depth)} * terrain::kBlockCells * 2;
    if (row2 < 0 || row2 >= up2) return false;
    column2 = (column2 + 2 * lattice.around()) % (2 * lattice.around());
    const auto cell = [](std::int64_t twice) {
        return static_cast<std::uint32_t>(twice / 2 / terrain::kBlockCells);
    };
    TileId tile{lattice.depth, cell(column2), cell(row2)};
    while (!drawn.contains(tile)) {
        if (tile.depth == 0) return false;
        tile = terrain::parent(tile);
    }
    return true;
}

/// Everything drawn, laid out on the lattice. Flat lists, sorted later: a frame has millions of edges.
struct DrawnMesh {
    Lattice lattice;
    DrawnTiles drawn;
    std::vector<LatticeEdge> edges;
    std::vector<PostUse> posts;
    std::size_t folded = 0;

    void add(const BlockDraw& draw, std::span<const std::uint16_t> triangles) {
        std::bitset<terrain::kBlockVertices> used;
        for (std::size_t i = 0; i < triangles.size(); i += 3) {
            std::array<std::array<std::int64_t, 2>, 3> corner{};
            for (std::size_t c = 0; c < 3; ++c) {
                const std::size_t index = triangles[i + c];
                corner[c] = lattice.post(draw.node->tile, static_cast<int>(index));
                if (used[index]) continue;
                used.set(index);
                posts.push_back({lattice.name(corner[c]), &draw.node->block->vertices[index]});
            }
            const std::int64_t turn = (corner[1][1] - corner[0][1]) * (corner[2][0] - corner[0][0]) -
                                      (corner[2][1] - corner[0][1]) * (corner[1][0] - corner[0][0]);
            if (turn <= 0) ++folded;
            for (std::size_t c = 0; c < 3; ++c)
                edges.push_back(make_edge(lattice, corner[c], corner[(c + 1) % 3]));
        }
    }
};

std::size_t count_unequal_bits(std::vector<PostUse>& posts) {
    std::sort(posts.begin(), posts.end(), [](const PostUse& a, const PostUse& b) { return a.name < b.name; });
    std::size_t unequal = 0;
    for (std::size_t i = 1; i < posts.size(); ++i) {
        if (posts[i].name == posts[i - 1].name && !same_bits(*posts[i].vertex, *posts[i - 1].vertex))
            ++unequal;
    }
    return unequal;
}

void count_edge_faults(DrawnMesh& mesh, MeshFaults& faults) {
    auto& edges = mesh.edges;
    std::sort(edges.begin(), edges.end(),
              [](const LatticeEdge& a, const LatticeEdge& b) { return a.ends < b.ends; });
    const std::int64_t pole = std::int64_t{terrain::tiles_up(mesh.lattice.depth)} * terrain::kBlockCells;
    for (auto first = edges.begin(); first != edges.end();) {
        const auto last = std::find_if(first, edges.end(),
                                       [&](const LatticeEdge& edge) { return edge.ends != first->ends; });
        const auto forward = std::count_if(first, last, [](const LatticeEdge& edge) { return edge.forward; });
        const auto uses = last - first;
        ++faults.edges;
        if (forward > 1 || uses - forward > 1) ++faults.overlaps;
        const bool at_pole = first->a[0] == first->b[0] && (first->a[0] == 0 || first->a[0] == pole);
        if (uses == 1 && !at_pole && drawn_across(*first, mesh.lattice, mesh.drawn)) ++faults.cracks;
        first = last;
    }
}

}  // namespace

MeshFaults find_faults(std::span<const BlockDraw> draws, std::span<const std::uint16_t> indices) {
    DrawnMesh mesh;
    for (const BlockDraw& draw : draws) {
        mesh.lattice.depth = std::max(mesh.lattice.depth, draw.node->tile.depth);
        mesh.drawn.insert(draw.node->tile);
    }
    for (const BlockDraw& draw : draws) mesh.add(draw, terrain::indices_of(draw, indices));
    MeshFaults faults;
    faults.folded = mesh.folded;
    faults.unequal_bits = count_unequal_bits(mesh.posts);
    count_edge_faults(mesh, faults);
    return faults;
}

}  // namespace eyepoint::testing
