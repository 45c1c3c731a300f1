#include "tools/terrain/nest/collapse.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <tuple>
#include <utility>

#include "terrain/block/block.hpp"
#include "terrain/database/database.hpp"
#include "terrain/lod/error_level.hpp"
#include "tools/terrain/nest/triangle_errors.hpp"

namespace eyepoint::tools {

using namespace terrain;

namespace {

using Vertex = std::uint16_t;
using Triangle = std::array<Vertex, 3>;

/// Share of a level's error that its mesh may have. The rest covers what is not checked: vertices sliding
/// side by side, levels differing over a triangle, rounding.
constexpr double kMeshShare = 0.97;
constexpr float kNever = std::numeric_limits<float>::infinity();

/// Vertices that four tiles may hand to their parent, each: so that the parent has at most kBlockVertices.
/// Only terrain rougher than any met needs more; it gets a greater error then.
constexpr std::size_t kMostLeft = kBlockVertices / 4;

float allowed_m(double level) {
    return static_cast<float>(kMeshShare * kFinestErrorM * std::exp2(0.5 * level));
}

/// A corner with its exact place.
struct Placed {
    std::int64_t x = 0;
    std::int64_t y = 0;
    Corner corner;
};

bool same_place(const Placed& a, const Placed& b) { return a.x == b.x && a.y == b.y; }

bool counterclockwise(const Placed& a, const Placed& b, const Placed& c) {
    // Places slid beyond the tile may be far from it: the products need more than 64 bits.
    __extension__ using Wide = __int128;
    return Wide{b.x - a.x} * (c.y - a.y) > Wide{b.y - a.y} * (c.x - a.x);
}

class Collapse {
  public:
    Collapse(const CollapseRequest& request, const SampledSurface& surface)
        : request_(request), surface_(surface), triangles_(request.mesh.triangles) {
        const std::size_t vertices = request.mesh.vertices.size();
        around_.resize(vertices);
        version_.resize(vertices);
        last_error_m_.resize(vertices);
        used_as_target_.resize(vertices, -1);
        result_.gone_level.assign(vertices, NestedMesh::kStays);
        result_.target.assign(vertices, 0);
        for (const MeshVertex& vertex : request.mesh.vertices) places_.push_back(placed(vertex));
        for (const Placed& place : places_) is_corner_.push_back(is_tile_corner(place));
        for (const EdgeFate& fate : request.fates) {
            auto& steps = later_places_.emplace_back();
            for (const EdgeFate::Step& step : fate.steps) steps.push_back({step.level, placed(step.place)});
        }
        for (std::size_t t = 0; t < triangles_.size(); ++t) {
            for (const Vertex corner : triangles_[t])
                around_[corner].push_back(static_cast<std::uint32_t>(t));
        }
        dead_.resize(triangles_.size(), false);
    }

    CollapseResult run() {
        edges_done_ = level_ = request_.first_level;
        collapse_edges();
        for (std::size_t v = 0; v < around_.size(); ++v) touch(static_cast<Vertex>(v));
        while (level_ < request_.last_level) {
            begin_level();
            edges_done_ = ++level_;
            for (const Vertex touched : collapse_edges()) touch(touched);
            collapse_inner(allowed_m(level_));
        }
        for (least_error_m_ = 2.0F * allowed_m(level_); vertices_left() > kMostLeft && least_error_m_ < 1e7F;
             least_error_m_ *= 2.0F) {
            used_as_target_.assign(used_as_target_.size(), -1);
            last_error_m_.assign(last_error_m_.size(), 0.0F);
            for (std::size_t v = 0; v < around_.size(); ++v) touch(static_cast<Vertex>(v));
            collapse_inner(least_error_m_);
        }
        follow_targets();
        for (std::size_t t = 0; t < triangles_.size(); ++t) {
            if (!dead_[t]) result_.coarsest.push_back(triangles_[t]);
        }
        return std::move(result_);
    }

  private:
    static constexpr Vertex kNone = 0xffff;
    static constexpr Vertex kAll = 0xfffe;
    struct LaterPlace {
        int level;
        Placed place;
    };
    struct Candidate {
        float error_m;
        Vertex vertex;
        Vertex target;
        std::uint32_t version;
        bool operator>(const Candidate& other) const {
            return std::tie(error_m, vertex) > std::tie(other.error_m, other.vertex);
        }
    };

    [[nodiscard]] Placed placed(const MeshVertex& vertex) const {
        const double side_deg = tile_side_deg(request_.tile.depth);
        const GeographicExtent sides = extent(request_.tile);
        const double x = static_cast<double>(vertex.x) / kPlaceUnits,
                     y = static_cast<double>(vertex.y) / kPlaceUnits;
        const double cells = surface_.side() - 1;
        return {vertex.x,
                vertex.y,
                {x * cells, y * cells,
                 surface_.position_m(sides.south_deg + y * side_deg, sides.west_deg + x * side_deg,
                                     vertex.height_m)}};
    }

    [[nodiscard]] bool gone(Vertex v) const { return result_.gone_level[v] != NestedMesh::kStays; }

    [[nodiscard]] std::vector<Vertex> ring(Vertex v) const {
        std::vector<Vertex> vertices;
        for (const std::uint32_t t : around_[v]) {
            for (const Vertex corner : triangles_[t]) {
                if (corner != v && std::find(vertices.begin(), vertices.end(), corner) == vertices.end())
                    vertices.push_back(corner);
            }
        }
        return vertices;
    }

    /// Takes the edge vertices whose level has come; returns the vertices whose triangles changed. The tile's
    /// corners are never taken: they slide on in its parent's mesh.
    std::vector<Vertex> collapse_edges() {
        std::vector<Vertex> due, touched;
        for (std::size_t i = 0; i < later_places_.size(); ++i) {
            const auto v = static_cast<Vertex>(i);
            if (!later_places_[v].empty() && later_places_[v].front().level <= level_ && !gone(v) &&
                !is_corner_[v])
                due.push_back(v);
        }
        std::stable_sort(due.begin(), due.end(), [&](Vertex a, Vertex b) {
            return later_places_[a].front().level < later_places_[b].front().level;
        });
        // One whose target is not beside it yet waits for those between.
        for (bool progress = true; progress;) {
            progress = false;
            for (const Vertex v : due) {
                if (gone(v)) continue;
                const auto neighbours = ring(v);
                const LaterPlace& next = later_places_[v].front();
                const auto target = std::find_if(neighbours.begin(), neighbours.end(), [&](Vertex w) {
                    return same_place(places_[w], next.place) && shared_triangles(v, w) == 1;
                });
                if (target == neighbours.end()) continue;
                touched.insert(touched.end(), neighbours.begin(), neighbours.end());
                clear_way(v, *target, touched);
                apply(v, *target, next.level);
                progress = true;
                break;  // those of lower levels first
            }
        }
        follow_targets();
        std::sort(touched.begin(), touched.end());
        touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
        return touched;
    }

    /// What went to a vertex that went at the same level goes to where that went.
    void follow_targets() {
        for (std::size_t v = 0; v < result_.target.size(); ++v) {
            if (result_.gone_level[v] == NestedMesh::kStays) continue;
            Vertex& target = result_.target[v];
            while (result_.gone_level[target] <= result_.gone_level[v]) target = result_.target[target];
        }
    }

    /// One for neighbours on the mesh's border.
    [[nodiscard]] std::ptrdiff_t shared_triangles(Vertex a, Vertex b) const {
        return std::count_if(around_[a].begin(), around_[a].end(), [&](std::uint32_t t) {
            return std::find(triangles_[t].begin(), triangles_[t].end(), b) != triangles_[t].end();
        });
    }

    /// Before an edge vertex goes: inner vertices whose triangles would fold go first. Triangles made here
    /// never need it (outlasts_edges); those of the first mesh beside a corner of a tile may.
    void clear_way(Vertex v, Vertex target, std::vector<Vertex>& touched) {
        edges_done_ = level_ - 1;
        for (bool folds = true; folds;) {
            folds = false;
            for (const Vertex inner : in_the_way(v, target)) {
                if (!move_away(inner, v, touched)) continue;
                folds = true;
                break;
            }
        }
        edges_done_ = level_;
    }

    /// Takes an inner vertex away, or one beside it where the triangles around it are seen whole from no
    /// corner.
    bool move_away(Vertex inner, Vertex edge, std::vector<Vertex>& touched) {
        std::vector<Vertex> candidates = ring(inner);
        std::erase_if(candidates, [&](Vertex v) { return request_.fates[v].on_edge; });
        candidates.insert(candidates.begin(), inner);
        for (const Vertex candidate : candidates) {
            const Vertex best = way_out(candidate, edge);
            if (best == candidate) continue;
            const auto neighbours = ring(candidate);
            touched.insert(touched.end(), neighbours.begin(), neighbours.end());
            apply(candidate, best, level_);
            return true;
        }
        return false;
    }

    /// A target for an inner vertex in the way of an edge vertex, whatever the error: one that leaves
    /// triangles that outlast the edges, or that do so unfolded, or some that do not at that edge vertex
    /// alone, or any.
    [[nodiscard]] Vertex way_out(Vertex inner, Vertex edge) {
        Vertex best = best_target(inner, kNever, kNone).target;
        const float least_error_m = std::exchange(least_error_m_, kNever);
        for (const Vertex excepted : {kNone, edge, kAll}) {
            if (best == inner) best = best_target(inner, kNever, excepted).target;
        }
        least_error_m_ = least_error_m;
        return best;
    }

    [[nodiscard]] std::vector<Vertex> in_the_way(Vertex v, Vertex target) const {
        std::vector<Vertex> inner;
        for (const std::uint32_t t : around_[v]) {
            std::array<const Placed*, 3> corners{};
            for (std::size_t i = 0; i < 3; ++i)
                corners[i] = &here(triangles_[t][i] == v ? target : triangles_[t][i]);
            if (is_empty(corners) || counterclockwise(*corners[0], *corners[1], *corners[2])) continue;
            for (const Vertex corner : triangles_[t]) {
                if (!request_.fates[corner].on_edge) inner.push_back(corner);
            }
        }
        return inner;
    }

    [[nodiscard]] std::size_t vertices_left() const {
        return static_cast<std::size_t>(
            std::count(result_.gone_level.begin(), result_.gone_level.end(), NestedMesh::kStays));
    }

    void collapse_inner(float most_m) {
        std::vector<Candidate> later;
        while (!queue_.empty() && queue_.top().error_m <= most_m) {
            const Candidate next = queue_.top();
            queue_.pop();
            if (next.version != version_[next.vertex] || gone(next.vertex)) continue;
            if (next.target == kNone) {
                weigh(next.vertex, std::max(most_m, allowed_m(request_.last_level)));
                continue;
            }
            const Vertex first = request_.waits_for[next.vertex];
            if (used_as_target_[next.vertex] == level_ || (first != next.vertex && !gone(first)) ||
                (most_m <= allowed_m(level_) && !slides_well(next))) {
                later.push_back(next);
                continue;
            }
            const auto touched = ring(next.vertex);
            apply(next.vertex, next.target, level_);
            for (const Vertex vertex : touched) touch(vertex);
        }
        for (const Candidate& candidate : later) queue_.push(candidate);
    }

    /// Queues an inner vertex whose triangles have changed, by the error it had: what it is now is found out
    /// when its turn comes, mostly after some more changes.
    void touch(Vertex v) {
        if (gone(v) || request_.fates[v].on_edge) return;
        queue_.push({last_error_m_[v], v, kNone, ++version_[v]});
    }

    /// Queues it with its best target.
    void weigh(Vertex v, float most_m) {
        const Candidate best = best_target(v, most_m, kNone);
        last_error_m_[v] = best.target != v ? best.error_m : 0.0F;  // without a target: soon again
        if (best.target != v) queue_.push(best);
    }

    /// A neighbour that a vertex may go to, and what the sides of the triangles left would cost alone.
    struct Way {
        float by_size_m;
        std::size_t number;  ///< among the neighbours: the first of equals is taken
        Vertex target;
        bool operator<(const Way& other) const {
            return std::tie(by_size_m, number) < std::tie(other.by_size_m, other.number);
        }
    };

    /// Itself when there is none within the error. New triangles at `excepted` need not outlast the edges'
    /// collapses. Ways are tried by the least they can cost, so that most need not be.
    [[nodiscard]] Candidate best_target(Vertex v, float most_m, Vertex excepted) {
        Candidate best{most_m, v, v, version_[v]};
        const auto neighbours = ring(v);
        ways_.clear();
        for (std::size_t i = 0; i < neighbours.size(); ++i) {
            const auto& later = later_places_[neighbours[i]];
            if (!later.empty() && later.front().level <= edges_done_) continue;
            const float by_size_m = size_cost_m(v, neighbours[i]);
            if (by_size_m <= most_m && by_size_m < kNever) ways_.push_back({by_size_m, i, neighbours[i]});
        }
        std::sort(ways_.begin(), ways_.end());
        std::size_t best_number = neighbours.size();
        for (const Way& way : ways_) {
            if (std::tie(way.by_size_m, way.number) > std::tie(best.error_m, best_number)) break;
            const float error_m = error_after(v, way, best.error_m, excepted);
            if (error_m < kNever && std::tie(error_m, way.number) < std::tie(best.error_m, best_number)) {
                best.error_m = error_m;
                best.target = way.target;
                best_number = way.number;
            }
        }
        return best;
    }

    /// The corners of a triangle when a vertex has gone to a target.
    [[nodiscard]] std::array<const Placed*, 3> corners_after(const Triangle& triangle, Vertex v,
                                                             Vertex target) const {
        std::array<const Placed*, 3> corners{};
        for (std::size_t i = 0; i < 3; ++i) corners[i] = &here(triangle[i] == v ? target : triangle[i]);
        return corners;
    }

    [[nodiscard]] static bool has(const Triangle& triangle, Vertex v) {
        return triangle[0] == v || triangle[1] == v || triangle[2] == v;
    }

    /// The error of the level from which the longest side that a collapse would leave around the vertex may
    /// be; kNever when it would fold a triangle.
    [[nodiscard]] float size_cost_m(Vertex v, Vertex target) const {
        constexpr auto kErrorASide = static_cast<float>(kMeshShare * kFinestErrorM / kLevelReachM);
        float longest_m = 0.0F;
        std::size_t count = 0;
        for (const std::uint32_t t : around_[v]) {
            if (has(triangles_[t], target)) continue;
            if (count++ == kMostAround) return kNever;
            const auto corners = corners_after(triangles_[t], v, target);
            if (is_empty(corners)) continue;
            const auto& [a, b, c] = corners;
            if (!counterclockwise(*a, *b, *c)) return kNever;
            longest_m =
                std::max({longest_m, surface_.side_m(a->corner, b->corner),
                          surface_.side_m(b->corner, c->corner), surface_.side_m(c->corner, a->corner)});
        }
        return kErrorASide * longest_m;
    }

    /// Greatest error of the triangles that a collapse would leave around the vertex, or what their sides
    /// cost if that is more; kNever when it must not be, or when it is more than `enough_m`.
    [[nodiscard]] float error_after(Vertex v, const Way& way, float enough_m, Vertex excepted) {
        float greatest_m = way.by_size_m;
        for (const std::uint32_t t : around_[v]) {
            if (has(triangles_[t], way.target)) continue;
            const float error_m = error_after(triangles_[t], v, way.target, enough_m);
            if (error_m > enough_m) return kNever;
            greatest_m = std::max(greatest_m, error_m);
        }
        for (const std::uint32_t t : around_[v]) {
            Triangle triangle = triangles_[t];
            if (has(triangle, way.target)) continue;
            std::replace(triangle.begin(), triangle.end(), v, way.target);
            const bool is_excepted = excepted == kAll || has(triangle, excepted);
            if (!is_excepted && !outlasts_edges(triangle)) return kNever;
        }
        return greatest_m;
    }

    /// Of one triangle; 0 for an empty one.
    [[nodiscard]] float error_after(Triangle triangle, Vertex v, Vertex target, float enough_m) {
        std::replace(triangle.begin(), triangle.end(), v, target);
        const auto measure = [&](float most_m) {
            const std::array<const Placed*, 3> corners{&here(triangle[0]), &here(triangle[1]),
                                                       &here(triangle[2])};
            if (is_empty(corners)) return 0.0F;
            return surface_.error_m(corners[0]->corner, corners[1]->corner, corners[2]->corner, most_m);
        };
        const bool moves =
            std::any_of(triangle.begin(), triangle.end(), [&](Vertex corner) { return is_corner_[corner]; });
        return moves ? measure(enough_m) : errors_.find(triangle, enough_m, measure);
    }

    /// Whether a triangle stays unfolded and within its level's error whenever the edges' vertices go on.
    [[nodiscard]] bool outlasts_edges(const Triangle& triangle) const {
        if (later_places_[triangle[0]].empty() && later_places_[triangle[1]].empty() &&
            later_places_[triangle[2]].empty())
            return true;
        int level = edges_done_;
        while (true) {
            int next = std::numeric_limits<int>::max();
            for (const Vertex corner : triangle) {
                for (const LaterPlace& later : later_places_[corner]) {
                    if (later.level > level) next = std::min(next, later.level);
                }
            }
            if (next == std::numeric_limits<int>::max()) return true;
            level = next;
            const std::array<const Placed*, 3> corners{
                &at_level(triangle[0], level), &at_level(triangle[1], level), &at_level(triangle[2], level)};
            if (is_empty(corners)) return true;
            if (!counterclockwise(*corners[0], *corners[1], *corners[2])) return false;
            const float enough_m = std::max(allowed_m(level), least_error_m_);
            if (surface_.error_m(corners[0]->corner, corners[1]->corner, corners[2]->corner, enough_m) >
                enough_m)
                return false;
        }
    }

    /// Where a vertex that is still in the mesh is at this level: only corners of the tile may have slid
    /// away.
    [[nodiscard]] const Placed& here(Vertex v) const {
        return is_corner_[v] ? at_level(v, edges_done_) : places_[v];
    }

    [[nodiscard]] static bool is_tile_corner(const Placed& place) {
        const auto at_end = [](std::int64_t at) { return at == 0 || at == kPlaceUnits; };
        return at_end(place.x) && at_end(place.y);
    }

    [[nodiscard]] static bool is_empty(const std::array<const Placed*, 3>& corners) {
        return same_place(*corners[0], *corners[1]) || same_place(*corners[1], *corners[2]) ||
               same_place(*corners[2], *corners[0]);
    }

    [[nodiscard]] const Placed& at_level(Vertex v, int level) const {
        const Placed* place = &places_[v];
        for (const LaterPlace& later : later_places_[v]) {
            if (later.level <= level) place = &later.place;
        }
        return *place;
    }

    /// Remembers the mesh as it is before any vertex goes at this level.
    void begin_level() {
        before_ = triangles_;
        first_before_.assign(around_.size() + 1, 0);
        around_before_.clear();
        for (std::size_t v = 0; v < around_.size(); ++v) {
            around_before_.insert(around_before_.end(), around_[v].begin(), around_[v].end());
            first_before_[v + 1] = around_before_.size();
        }
    }

    /// Whether the triangles around a vertex, while it and all that go at this level so far slide, stay
    /// unfolded and within what the level between allows.
    [[nodiscard]] bool slides_well(const Candidate& candidate) const {
        for (const double share : {0.25, 0.5, 0.75}) {
            const float enough_m = allowed_m(level_ - 1 + share);
            for (std::size_t i = first_before_[candidate.vertex]; i < first_before_[candidate.vertex + 1U];
                 ++i) {
                const Triangle& triangle = before_[around_before_[i]];
                const std::array<Corner, 3> corners{on_the_way(triangle[0], candidate, share),
                                                    on_the_way(triangle[1], candidate, share),
                                                    on_the_way(triangle[2], candidate, share)};
                const auto& [a, b, c] = corners;
                const double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
                if (area < -1e-9) return false;
                if (area > 1e-9 && surface_.error_m(a, b, c, enough_m) > enough_m) return false;
            }
        }
        return true;
    }

    /// Where a vertex of the mesh before this level is when a share of the slide is done and the candidate
    /// goes too.
    [[nodiscard]] Corner on_the_way(Vertex v, const Candidate& candidate, double share) const {
        const Corner& from = here(v).corner;
        const bool slides = v == candidate.vertex || result_.gone_level[v] == level_;
        if (!slides) return from;
        const Corner& to = here(v == candidate.vertex ? candidate.target : result_.target[v]).corner;
        Corner corner{from.x + share * (to.x - from.x), from.y + share * (to.y - from.y), {}};
        const auto part = static_cast<float>(share);
        for (std::size_t i = 0; i < 3; ++i)
            corner.position_m[i] = from.position_m[i] + part * (to.position_m[i] - from.position_m[i]);
        return corner;
    }

    void apply(Vertex v, Vertex target, int level) {
        result_.gone_level[v] = static_cast<std::uint8_t>(level);
        result_.target[v] = target;
        used_as_target_[target] = level;
        for (const std::uint32_t t : around_[v]) {
            Triangle& triangle = triangles_[t];
            if (std::find(triangle.begin(), triangle.end(), target) != triangle.end()) {
                dead_[t] = true;
                for (const Vertex corner : triangle) {
                    if (corner != v) std::erase(around_[corner], t);
                }
            } else {
                std::replace(triangle.begin(), triangle.end(), v, target);
                around_[target].push_back(t);
            }
        }
        around_[v].clear();
    }

    static constexpr std::size_t kMostAround = 64;

    const CollapseRequest& request_;
    const SampledSurface& surface_;
    int level_ = 0;
    float least_error_m_ = 0.0F;  ///< that is allowed whatever the level, once too many vertices are left
    int edges_done_ = 0;          ///< the level that the edges' vertices have been taken to
    std::vector<Triangle> triangles_;
    std::vector<bool> dead_;
    std::vector<Triangle> before_;  ///< triangles_ at the start of the level; and around_, in one row
    std::vector<std::uint32_t> around_before_;
    std::vector<std::size_t> first_before_;
    std::vector<std::vector<std::uint32_t>> around_;  ///< triangles, by vertex
    std::vector<Placed> places_;
    std::vector<char> is_corner_;  ///< of the tile
    std::vector<std::vector<LaterPlace>> later_places_;
    std::vector<std::uint32_t> version_;
    std::vector<float> last_error_m_;  ///< by vertex: of its best collapse when it was last weighed
    std::vector<int> used_as_target_;  ///< the level at which
    std::priority_queue<Candidate, std::vector<Candidate>, std::greater<>> queue_;
    TriangleErrors errors_;
    std::vector<Way> ways_;
    CollapseResult result_;
};

}  // namespace

CollapseResult collapse(const CollapseRequest& request, const SampledSurface& surface) {
    return Collapse{request, surface}.run();
}

}  // namespace eyepoint::tools
