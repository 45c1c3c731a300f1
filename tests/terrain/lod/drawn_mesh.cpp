#include "tests/terrain/lod/drawn_mesh.hpp"

#include <cstring>
#include <map>
#include <unordered_set>

namespace eyepoint::testing {

namespace {

using terrain::BlockDraw;
using terrain::TileId;

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

struct EdgeUse {
    int forward = 0;  ///< times met from the smaller name to the larger
    int backward = 0;
    std::array<std::int64_t, 2> a{};
    std::array<std::int64_t, 2> b{};
};

using Edges = std::map<std::array<std::uint64_t, 2>, EdgeUse>;

void add_edge(Edges& edges, const Lattice& lattice, std::array<std::int64_t, 2> a,
              std::array<std::int64_t, 2> b) {
    const std::uint64_t from = lattice.name(a), to = lattice.name(b);
    EdgeUse& use = edges[{std::min(from, to), std::max(from, to)}];
    ++(from < to ? use.forward : use.backward);
    use.a = a;
    use.b = b;
}

/// Whether the place just across an edge (its triangle lies on its left, the place on its right) is in a
/// drawn tile.
bool drawn_across(const EdgeUse& use, const Lattice& lattice,
                  const std::unordered_set<TileId, terrain::TileHash>& drawn) {
    const std::int64_t d_row = use.b[0] - use.a[0], d_column = use.b[1] - use.a[1];
    // Middle of the edge in half steps, moved half a step to the right of its direction.
    const std::int64_t row2 = use.a[0] + use.b[0] + (d_column > 0 ? -1 : d_column < 0 ? 1 : 0);
    std::int64_t column2 = use.a[1] + use.b[1] + (d_row > 0 ? 1 : d_row < 0 ? -1 : 0);
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

}  // namespace

MeshFaults find_faults(std::span<const BlockDraw> draws, std::span<const std::uint16_t> indices) {
    Lattice lattice;
    std::unordered_set<TileId, terrain::TileHash> drawn;
    for (const BlockDraw& draw : draws) {
        lattice.depth = std::max(lattice.depth, draw.node->tile.depth);
        drawn.insert(draw.node->tile);
    }
    MeshFaults faults;
    Edges edges;
    std::unordered_map<std::uint64_t, const terrain::BlockVertex*> vertices;
    const std::int64_t pole = std::int64_t{terrain::tiles_up(lattice.depth)} * terrain::kBlockCells;
    for (const BlockDraw& draw : draws) {
        for (std::uint32_t i = draw.indices.first; i < draw.indices.first + draw.indices.count; i += 3) {
            std::array<std::array<std::int64_t, 2>, 3> corner{};
            for (std::size_t c = 0; c < 3; ++c) {
                const int index = indices[i + c];
                corner[c] = lattice.post(draw.node->tile, index);
                const auto& vertex = draw.node->block->vertices[static_cast<std::size_t>(index)];
                const auto [known, added] = vertices.emplace(lattice.name(corner[c]), &vertex);
                const bool same = std::memcmp(known->second->high.data(), vertex.high.data(), 12) == 0 &&
                                  std::memcmp(known->second->low.data(), vertex.low.data(), 12) == 0;
                if (!added && !same) ++faults.unequal_bits;
            }
            const std::int64_t turn = (corner[1][1] - corner[0][1]) * (corner[2][0] - corner[0][0]) -
                                      (corner[2][1] - corner[0][1]) * (corner[1][0] - corner[0][0]);
            if (turn <= 0) ++faults.folded;
            for (std::size_t c = 0; c < 3; ++c) add_edge(edges, lattice, corner[c], corner[(c + 1) % 3]);
        }
    }
    for (const auto& [ends, use] : edges) {
        ++faults.edges;
        if (use.forward > 1 || use.backward > 1) ++faults.overlaps;
        if (use.forward + use.backward != 1) continue;
        const bool at_pole = use.a[0] == use.b[0] && (use.a[0] == 0 || use.a[0] == pole);
        if (!at_pole && drawn_across(use, lattice, drawn)) ++faults.cracks;
    }
    return faults;
}

}  // namespace eyepoint::testing
