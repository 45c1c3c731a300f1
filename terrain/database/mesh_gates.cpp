#include "terrain/database/mesh_gates.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <unordered_map>

#include "terrain/database/mesh_structure.hpp"

namespace eyepoint::terrain {

namespace {

using Vertex = std::uint16_t;
using Corners = std::array<Vertex, 3>;

struct Gate {
    Vertex from = 0;  ///< the triangle looked for lies to the left
    Vertex to = 0;
};

/// Third corners that are ranked: the nearest to where the corner of an equilateral triangle would be.
constexpr std::size_t kMaxCandidates = 10;
/// Cells a side by which they are found.
constexpr int kGateCells = kBlockCells / 2;
/// Vertices that are looked at for them.
constexpr std::size_t kMaxLookedAt = 40;

struct TriangleModels {
    NumberModel choice;  ///< by gate: 0 where no triangle is beyond it, or 1 + the rank of the third corner
    NumberModel corner;  ///< of triangles that no gate leads to; and how many triangles there are
};

std::int64_t cross(Place origin, Place a, Place b) {
    return std::int64_t{a.x - origin.x} * (b.y - origin.y) - std::int64_t{a.y - origin.y} * (b.x - origin.x);
}
std::int64_t dot(Place origin, Place a, Place b) {
    return std::int64_t{a.x - origin.x} * (b.x - origin.x) + std::int64_t{a.y - origin.y} * (b.y - origin.y);
}

/// Products of two areas: below 2^124.
__extension__ using Wide = __int128;

struct Candidate {
    Vertex vertex = 0;
    std::int64_t cross = 0;  ///< of the directions to the gate's ends; above 0
    std::int64_t dot = 0;
    /// Sees the gate under the greater angle: its cotangent, dot / cross, is less.
    [[nodiscard]] bool before(const Candidate& other) const {
        const Wide ours = Wide{dot} * other.cross, theirs = Wide{other.dot} * cross;
        return ours != theirs ? ours < theirs : vertex < other.vertex;
    }
};

/// The triangulation as far as it has grown; the writer's and the reader's are alike at every gate.
class Front {
  public:
    explicit Front(std::span<const Place> places)
        : places_(places),
          index_(places, kGateCells),
          first_out_(places.size(), kNone),
          open_(places.size(), 0) {}

    void add(const Corners& corners) {
        const auto [a, b, c] = corners;
        for (const Gate edge : {Gate{a, b}, Gate{b, c}, Gate{c, a}}) {
            const bool closes = has(edge.to, edge.from);
            if (!closes && !is_border(edge)) {
                ++open_[edge.from], ++open_[edge.to];
                gates_.push_back({edge.to, edge.from});
            } else if (closes) {
                --open_[edge.from], --open_[edge.to];
            }
            out_.push_back({edge.to, first_out_[edge.from]});
            first_out_[edge.from] = static_cast<std::uint32_t>(out_.size() - 1);
        }
    }

    /// The next gate that is still open.
    std::optional<Gate> next() {
        while (next_gate_ < gates_.size()) {
            const Gate gate = gates_[next_gate_++];
            if (!has(gate.from, gate.to)) return gate;
        }
        return std::nullopt;
    }

    /// Looks for third corners beyond a gate. False where there are none.
    bool approach(Gate gate) {
        near_.clear();
        passed_.clear();
        gate_ = gate;
        std::size_t looked_at = 0;
        index_.visit_from(apex(places_[gate.from], places_[gate.to]), [&](std::size_t vertex) {
            consider(static_cast<Vertex>(vertex));
            return near_.size() < kMaxCandidates && ++looked_at < kMaxLookedAt;
        });
        return !near_.empty();
    }
    /// The most likely third corner that has not been given since; none with one of those in its triangle.
    std::optional<Vertex> next_corner() {
        while (!near_.empty()) {
            const auto best = std::ranges::min_element(
                near_, [](const Candidate& x, const Candidate& y) { return x.before(y); });
            const Vertex vertex = best->vertex;
            *best = near_.back();
            near_.pop_back();
            const bool free = std::ranges::none_of(passed_, [&](Vertex inner) {
                return is_inside(places_[inner], places_[gate_.from], places_[gate_.to], places_[vertex]);
            });
            if (!free) continue;
            passed_.push_back(vertex);
            return vertex;
        }
        return std::nullopt;
    }

  private:
    static constexpr std::uint32_t kNone = 0xffffffff;
    struct OutEdge {
        Vertex to = 0;
        std::uint32_t next = kNone;
    };

    [[nodiscard]] bool has(Vertex from, Vertex to) const {
        for (std::uint32_t at = first_out_[from]; at != kNone; at = out_[at].next) {
            if (out_[at].to == to) return true;
        }
        return false;
    }
    [[nodiscard]] bool is_border(Gate edge) const {
        return (sides_of(places_[edge.from]) & sides_of(places_[edge.to])) != 0;
    }
    [[nodiscard]] bool is_closed(Vertex vertex) const {
        return first_out_[vertex] != kNone && open_[vertex] == 0;
    }

    static Place apex(Place a, Place b) {
        const auto half = [](std::int64_t doubled) {
            return static_cast<std::int32_t>(std::clamp<std::int64_t>(doubled / 2, 0, kPlaceUnits));
        };
        return {half(std::int64_t{a.x} + b.x - b.y + a.y), half(std::int64_t{a.y} + b.y + b.x - a.x)};
    }

    static bool is_inside(Place point, Place a, Place b, Place c) {
        return cross(a, b, point) >= 0 && cross(b, c, point) >= 0 && cross(c, a, point) >= 0;
    }

    void consider(Vertex vertex) {
        const Place corner = places_[vertex];
        const std::int64_t area = cross(corner, places_[gate_.from], places_[gate_.to]);
        if (area <= 0 || is_closed(vertex) || has(gate_.to, vertex) || has(vertex, gate_.from)) return;
        near_.push_back({vertex, area, dot(corner, places_[gate_.from], places_[gate_.to])});
    }

    std::span<const Place> places_;
    PlaceIndex index_;
    std::vector<Gate> gates_;
    std::size_t next_gate_ = 0;
    std::vector<OutEdge> out_;  ///< directed edges of the triangles, in lists by where they start
    std::vector<std::uint32_t> first_out_;
    std::vector<std::int32_t> open_;  ///< by vertex: its edges with a triangle on one side only
    std::vector<Candidate> near_;
    std::vector<Vertex> passed_;
    Gate gate_;
};

/// The triangles still to be written, found by any of their edges.
class Unwritten {
  public:
    explicit Unwritten(std::span<const std::uint16_t> triangles) {
        for (std::size_t i = 0; i < triangles.size(); i += 3) {
            const Corners corners{triangles[i], triangles[i + 1], triangles[i + 2]};
            for (std::size_t side = 0; side < 3; ++side)
                by_edge_.emplace(key(corners[side], corners[(side + 1) % 3]), all_.size());
            all_.push_back(corners);
        }
        written_.resize(all_.size());
    }

    /// The third corner of a triangle at the gate.
    [[nodiscard]] std::optional<Vertex> third_corner(Gate gate) const {
        const auto [first, last] = by_edge_.equal_range(key(gate.from, gate.to));
        const auto found =
            std::find_if(first, last, [&](const auto& entry) { return !written_[entry.second]; });
        if (found == last) return std::nullopt;
        return opposite(all_[found->second], gate);
    }
    void take(const Corners& corners) {
        const auto [first, last] = by_edge_.equal_range(key(corners[0], corners[1]));
        const auto found = std::find_if(first, last, [&](const auto& entry) {
            return !written_[entry.second] &&
                   opposite(all_[entry.second], {corners[0], corners[1]}) == corners[2];
        });
        written_[found->second] = true;
    }

    /// The first that is unwritten; the caller has counted that there is one.
    Corners take_first() {
        while (written_[next_]) ++next_;
        written_[next_] = true;
        return all_[next_];
    }

    [[nodiscard]] std::size_t size() const { return all_.size(); }

  private:
    static std::uint32_t key(Vertex from, Vertex to) { return std::uint32_t{from} << 16 | to; }
    static Vertex opposite(const Corners& corners, Gate gate) {
        return *std::ranges::find_if(corners, [&](Vertex v) { return v != gate.from && v != gate.to; });
    }

    std::vector<Corners> all_;
    std::vector<bool> written_;
    std::unordered_multimap<std::uint32_t, std::size_t> by_edge_;
    std::size_t next_ = 0;
};

/// 1 + the rank of a third corner at the gate that was approached; 0 where it has none.
std::size_t rank_of(Vertex third, Front& front) {
    std::size_t rank = 0;
    for (auto corner = front.next_corner(); corner; corner = front.next_corner()) {
        ++rank;
        if (*corner == third) return rank;
    }
    return 0;
}
std::optional<Vertex> corner_at(std::uint64_t choice, Front& front) {
    std::optional<Vertex> corner = front.next_corner();
    for (std::uint64_t rank = 1; rank < choice && corner; ++rank) corner = front.next_corner();
    return corner;
}

}  // namespace

void encode_triangles(RangeEncoder& bytes, std::span<const Place> places,
                      std::span<const std::uint16_t> triangles) {
    Unwritten unwritten{triangles};
    Front front{places};
    TriangleModels models;
    bytes.number(models.corner, unwritten.size());
    for (std::size_t written = 0; written < unwritten.size();) {
        const auto gate = front.next();
        Corners corners{};
        if (!gate) {
            corners = unwritten.take_first();
            for (const Vertex corner : corners) bytes.number(models.corner, corner);
        } else {
            if (!front.approach(*gate)) continue;
            const auto third = unwritten.third_corner(*gate);
            const std::size_t choice = third ? rank_of(*third, front) : 0;
            bytes.number(models.choice, choice);
            if (choice == 0) continue;
            corners = {gate->from, gate->to, *third};
            unwritten.take(corners);
        }
        front.add(corners);
        ++written;
    }
}

tl::expected<std::vector<std::uint16_t>, std::string> decode_triangles(RangeDecoder& bytes,
                                                                       std::span<const Place> places) {
    NestedMesh mesh;
    Front front{places};
    TriangleModels models;
    const std::uint64_t triangles = bytes.number(models.corner);
    if (triangles > kMaxTriangles) return tl::unexpected(std::string{"it has too many triangles"});
    while (mesh.triangles.size() < 3 * triangles && !bytes.overrun()) {
        const auto gate = front.next();
        Corners corners{};
        if (!gate) {
            for (Vertex& corner : corners) {
                const std::uint64_t vertex = bytes.number(models.corner);
                if (vertex >= places.size())
                    return tl::unexpected(std::string{"a triangle's corner is no vertex"});
                corner = static_cast<Vertex>(vertex);
            }
        } else {
            if (!front.approach(*gate)) continue;
            const std::uint64_t choice = bytes.number(models.choice);
            if (choice == 0) continue;
            const auto third = corner_at(choice, front);
            if (!third) return tl::unexpected(std::string{"a triangle has no third corner"});
            corners = {gate->from, gate->to, *third};
        }
        front.add(corners);
        mesh.triangles.insert(mesh.triangles.end(), corners.begin(), corners.end());
    }
    return canonical_triangles(mesh);
}

}  // namespace eyepoint::terrain
