#include "tools/bench/measure/mesh_faults.hpp"

#include <algorithm>
#include <bit>
#include <optional>
#include <span>
#include <unordered_map>
#include <unordered_set>

#include <glm/geometric.hpp>

namespace eyepoint::tools {

namespace {

using terrain::Edge;
using terrain::TileId;

struct Bits {
    std::uint32_t x = 0, y = 0, z = 0;
    bool operator==(const Bits&) const = default;
};
struct BitsHash {
    std::size_t operator()(const Bits& bits) const noexcept {
        std::uint64_t hash = (std::uint64_t{bits.x} << 32 | bits.y) * 0x9e3779b97f4a7c15ULL;
        hash = (hash ^ (hash >> 32) ^ bits.z) * 0xd6e8feb86659fd93ULL;
        return static_cast<std::size_t>(hash ^ (hash >> 32));
    }
};

/// The same number for the same bits.
std::vector<std::uint32_t> number_by_bits(const std::vector<MeshVertex>& vertices) {
    std::unordered_map<Bits, std::uint32_t, BitsHash> numbers;
    numbers.reserve(vertices.size());
    std::vector<std::uint32_t> result;
    result.reserve(vertices.size());
    for (const MeshVertex& vertex : vertices) {
        const glm::vec3& at = vertex.from_eye;
        const Bits bits{std::bit_cast<std::uint32_t>(at.x), std::bit_cast<std::uint32_t>(at.y),
                        std::bit_cast<std::uint32_t>(at.z)};
        result.push_back(numbers.try_emplace(bits, static_cast<std::uint32_t>(numbers.size())).first->second);
    }
    return result;
}

/// One triangle's use of an edge.
struct EdgeUse {
    std::uint64_t ends = 0;  ///< numbers by bits, the smaller in the high half
    std::uint32_t part = 0;
    std::uint32_t from = 0, to = 0;  ///< vertices
    bool forward = true;             ///< from the smaller number to the larger
    bool empty = false;              ///< its triangle has slid shut
};

std::vector<EdgeUse> edge_uses(const DrawnMesh& mesh) {
    const std::vector<std::uint32_t> number = number_by_bits(mesh.vertices);
    std::vector<EdgeUse> uses;
    uses.reserve(mesh.triangles.size() * 3);
    for (std::uint32_t part = 0; part < mesh.parts.size(); ++part) {
        for (std::size_t i = mesh.parts[part].first_triangle; i < mesh.parts[part].end_triangle; ++i) {
            const auto& corners = mesh.triangles[i].vertices;
            const bool empty = is_empty(mesh, mesh.triangles[i]);
            for (std::size_t c = 0; c < 3; ++c) {
                const std::uint32_t from = corners[c], to = corners[(c + 1) % 3];
                const std::uint64_t low = std::min(number[from], number[to]),
                                    high = std::max(number[from], number[to]);
                if (low != high)
                    uses.push_back({low << 32 | high, part, from, to, number[from] == low, empty});
            }
        }
    }
    std::sort(uses.begin(), uses.end(), [](const EdgeUse& a, const EdgeUse& b) { return a.ends < b.ends; });
    return uses;
}

/// The edge of their tile that both vertices are on; of several (a corner's), the first.
std::optional<Edge> common_tile_edge(const MeshVertex& a, const MeshVertex& b) {
    for (std::size_t i = 0; i < terrain::kEdges.size(); ++i) {
        if ((a.tile_edges & b.tile_edges & (1U << i)) != 0) return terrain::kEdges[i];
    }
    return std::nullopt;
}

/// What is drawn, by tiles.
class DrawnArea {
  public:
    explicit DrawnArea(const DrawnMesh& mesh) {
        for (const MeshPart& part : mesh.parts) {
            tiles_.insert(part.tile);
            for (TileId tile = part.tile; tile.depth > 0 && above_.insert(parent(tile)).second;)
                tile = parent(tile);
        }
    }

    /// Whether the place just across a tile's edge, between two places on it, is in a drawn tile.
    [[nodiscard]] bool drawn_across(TileId tile, Edge edge, const glm::u16vec2& a,
                                    const glm::u16vec2& b) const {
        const auto beside = neighbour(tile, edge);
        if (!beside) return false;
        TileId at = *beside;
        for (; !tiles_.contains(at); at = parent(at))
            if (at.depth == 0) break;
        if (tiles_.contains(at)) return true;
        // Finer tiles may be drawn there: down to the one at the middle of the two places.
        const bool upright = edge == Edge::West || edge == Edge::East;
        double along = (upright ? a.y + b.y : a.x + b.x) / (2.0 * terrain::kVertexPlaceUnits);
        const int near_side = edge == Edge::West || edge == Edge::South ? 1 : 0;
        for (at = *beside; above_.contains(at);) {
            const int far_half = along >= 0.5 ? 1 : 0;
            along = along * 2.0 - far_half;
            at = child(at, upright ? far_half * 2 + near_side : near_side * 2 + far_half);
            if (tiles_.contains(at)) return true;
        }
        return false;
    }

  private:
    std::unordered_set<TileId, terrain::TileHash> tiles_, above_;
};

class FaultCount {
  public:
    explicit FaultCount(const DrawnMesh& mesh) : mesh_(mesh), area_(mesh) {}

    void add(std::span<const EdgeUse> uses) {
        ++faults_.edges;
        std::size_t forward = 0, backward = 0, real_forward = 0, real_backward = 0;
        bool border = false;
        for (const EdgeUse& use : uses) {
            (use.forward ? forward : backward) += 1;
            if (!use.empty) (use.forward ? real_forward : real_backward) += 1;
        }
        if (real_forward > 1 || real_backward > 1) ++faults_.overlaps;
        if (forward == backward) return;
        for (const EdgeUse& use : uses) border = border || is_border(use);
        ++(border ? faults_.borders : faults_.cracks);
    }

    [[nodiscard]] const MeshFaults& faults() const { return faults_; }

  private:
    [[nodiscard]] bool is_border(const EdgeUse& use) const {
        const MeshVertex &a = mesh_.vertices[use.from], &b = mesh_.vertices[use.to];
        const auto outside = [&](const glm::dvec3& side) {
            return glm::dot(side, glm::dvec3{a.from_eye}) < 0.0 &&
                   glm::dot(side, glm::dvec3{b.from_eye}) < 0.0;
        };
        if (std::any_of(mesh_.sides.begin(), mesh_.sides.end(), outside)) return true;
        if (behind_horizon(a) && behind_horizon(b)) return true;
        const auto edge = common_tile_edge(a, b);
        return edge && !area_.drawn_across(mesh_.parts[use.part].tile, *edge, a.own_place, b.own_place);
    }

    [[nodiscard]] bool behind_horizon(const MeshVertex& vertex) const {
        return horizon_.hides(mesh_.eye + glm::dvec3{vertex.from_eye});
    }

    const DrawnMesh& mesh_;
    terrain::HorizonOccluder horizon_{mesh_.eye, mesh_.lowest_height_m};
    DrawnArea area_;
    MeshFaults faults_;
};

}  // namespace

MeshFaults find_mesh_faults(const DrawnMesh& mesh) {
    const std::vector<EdgeUse> uses = edge_uses(mesh);
    FaultCount count(mesh);
    for (std::size_t first = 0; first < uses.size();) {
        std::size_t end = first + 1;
        while (end < uses.size() && uses[end].ends == uses[first].ends) ++end;
        count.add(std::span{uses}.subspan(first, end - first));
        first = end;
    }
    return count.faults();
}

}  // namespace eyepoint::tools
