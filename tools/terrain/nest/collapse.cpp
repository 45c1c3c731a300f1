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
#include "tools/terrain/nest/collapsing_mesh.hpp"
#include "tools/terrain/nest/slide.hpp"
#include "tools/terrain/nest/triangle_errors.hpp"
#include "tools/terrain/nest/triangle_set.hpp"
#include "tools/terrain/nest/vertex_places.hpp"

namespace eyepoint::tools {

using namespace terrain;

namespace {

using Vertex = CollapsingMesh::Vertex;
using Triangle = CollapsingMesh::Triangle;

/// Share of a level's error that its mesh may have. The rest covers what is not checked: levels differing
/// over a triangle, rounding.
constexpr double kMeshShare = 0.97;
/// Share of the error of the level between that a mesh may have on its way to a level. Of kToleranceShare of
/// a tolerance that is all of it.
constexpr double kSlideShare = 1.03;
static_assert(kSlideShare * kToleranceShare <= 1.0);
constexpr float kNever = std::numeric_limits<float>::infinity();

/// Within how many levels being in the way of an edge's vertex is soon.
constexpr int kLevelsAhead = 3;

/// Vertices that four tiles may hand to their parent, each: so that the parent has at most kBlockVertices.
/// Only terrain rougher than any met needs more; it gets a greater error then.
constexpr std::size_t kMostLeft = kBlockVertices / 4;

float allowed_m(double level) {
    return static_cast<float>(kMeshShare * kFinestErrorM * std::exp2(0.5 * level));
}

/// Of a slide that ends at a level.
SlideTolerance slide_tolerance(int level) {
    const auto at = [&](double share) {
        return static_cast<float>(kSlideShare * level_error_m(level - 1) * std::exp2(0.5 * share));
    };
    return {at(0.0), {at(0.25), at(0.5), at(0.75)}, {at(0.125), at(0.375), at(0.625), at(0.875)}};
}

class Collapse {
  public:
    Collapse(const CollapseRequest& request, const SampledSurface& surface)
        : request_(request), surface_(surface), mesh_(request.mesh), places_(request, surface) {
        const std::size_t vertices = mesh_.vertices();
        version_.resize(vertices);
        last_error_m_.resize(vertices);
        refused_.resize(vertices);
        used_as_target_.resize(vertices, -1);
    }

    CollapseResult run() {
        edges_done_ = level_ = request_.first_level;
        collapse_edges();
        for (std::size_t v = 0; v < mesh_.vertices(); ++v) touch(static_cast<Vertex>(v));
        while (level_ < request_.last_level) {
            mesh_.remember();
            edges_done_ = ++level_;
            for (const Vertex touched : collapse_edges()) touch(touched);
            collapse_inner(allowed_m(level_));
        }
        any_slide_will_do_ = true;
        for (least_error_m_ = allowed_m(level_); mesh_.vertices_left() > kMostLeft && least_error_m_ < 1e7F;
             least_error_m_ *= 2.0F) {
            used_as_target_.assign(used_as_target_.size(), -1);
            last_error_m_.assign(last_error_m_.size(), 0.0F);
            for (std::size_t v = 0; v < mesh_.vertices(); ++v) touch(static_cast<Vertex>(v));
            collapse_inner(least_error_m_);
        }
        mesh_.follow_targets();
        return mesh_.take();
    }

  private:
    static constexpr Vertex kNone = 0xffff;
    static constexpr Vertex kAll = 0xfffe;
    struct Candidate {
        float error_m;
        Vertex vertex;
        Vertex target;
        std::uint32_t version;
        bool operator>(const Candidate& other) const {
            return std::tie(error_m, vertex) > std::tie(other.error_m, other.vertex);
        }
    };

    /// Takes the edge vertices whose level has come; returns the vertices whose triangles changed. The tile's
    /// corners are never taken: they slide on in its parent's mesh.
    std::vector<Vertex> collapse_edges() {
        std::vector<Vertex> due, touched;
        for (std::size_t i = 0; i < mesh_.vertices(); ++i) {
            const auto v = static_cast<Vertex>(i);
            if (!places_.later(v).empty() && places_.later(v).front().level <= level_ && !mesh_.gone(v) &&
                !places_.is_corner(v))
                due.push_back(v);
        }
        std::stable_sort(due.begin(), due.end(), [&](Vertex a, Vertex b) {
            return places_.later(a).front().level < places_.later(b).front().level;
        });
        // One whose target is not beside it yet waits for those between.
        for (bool progress = true; progress;) {
            progress = false;
            for (const Vertex v : due) {
                if (mesh_.gone(v)) continue;
                const auto neighbours = mesh_.ring(v);
                const VertexPlaces::Later& next = places_.later(v).front();
                const auto target = std::find_if(neighbours.begin(), neighbours.end(), [&](Vertex w) {
                    return same_place(places_.own(w), next.place) && mesh_.shared_triangles(v, w) == 1;
                });
                if (target == neighbours.end()) continue;
                touched.insert(touched.end(), neighbours.begin(), neighbours.end());
                clear_way(v, *target, touched);
                apply(v, *target, next.level);
                progress = true;
                break;  // those of lower levels first
            }
        }
        mesh_.follow_targets();
        std::sort(touched.begin(), touched.end());
        touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
        return touched;
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

    /// Takes an inner vertex in the way of an edge vertex away, or one beside it, which may open a way for
    /// it.
    bool move_away(Vertex inner, Vertex edge, std::vector<Vertex>& touched) {
        const auto go = [&](Vertex vertex, Vertex target) {
            if (target == vertex) return false;
            const auto neighbours = mesh_.ring(vertex);
            touched.insert(touched.end(), neighbours.begin(), neighbours.end());
            apply(vertex, target, level_);
            return true;
        };
        std::vector<Vertex> beside = mesh_.ring(inner);
        std::erase_if(beside, [&](Vertex v) { return request_.fates[v].on_edge; });
        if (go(inner, way_out(inner, kNever))) return true;
        for (const Vertex vertex : beside) {
            if (go(vertex, way_out(vertex, allowed_m(level_)))) return true;
        }
        if (go(inner, any_way_out(inner, edge))) return true;
        return std::any_of(beside.begin(), beside.end(),
                           [&](Vertex vertex) { return go(vertex, any_way_out(vertex, edge)); });
    }

    /// A target within an error that leaves triangles that outlast the edges.
    [[nodiscard]] Vertex way_out(Vertex v, float most_m) {
        const Vertex best = best_target(v, most_m, kNone).target;
        if (best != v) return best;
        const bool any_slide_will_do = std::exchange(any_slide_will_do_, true);
        const Vertex other = best_target(v, most_m, kNone).target;
        any_slide_will_do_ = any_slide_will_do;
        return other;
    }

    /// A target, whatever the error: one that leaves triangles that outlast the edges unfolded, or that do so
    /// but for those at one vertex, or any.
    [[nodiscard]] Vertex any_way_out(Vertex v, Vertex edge) {
        Vertex best = v;
        const float least_error_m = std::exchange(least_error_m_, kNever);
        const bool any_slide_will_do = std::exchange(any_slide_will_do_, true);
        for (const Vertex excepted : {kNone, edge, kAll}) {
            if (best == v) best = best_target(v, kNever, excepted).target;
        }
        least_error_m_ = least_error_m;
        any_slide_will_do_ = any_slide_will_do;
        return best;
    }

    [[nodiscard]] std::vector<Vertex> in_the_way(Vertex v, Vertex target) const {
        std::vector<Vertex> inner;
        for (const std::uint32_t t : mesh_.around(v)) {
            PlacedTriangle corners{};
            for (std::size_t i = 0; i < 3; ++i)
                corners[i] = &here(mesh_.triangle(t)[i] == v ? target : mesh_.triangle(t)[i]);
            if (is_empty(corners) || counterclockwise(corners)) continue;
            for (const Vertex corner : mesh_.triangle(t)) {
                if (!request_.fates[corner].on_edge) inner.push_back(corner);
            }
        }
        return inner;
    }

    void collapse_inner(float most_m) {
        std::vector<Candidate> later;
        while (!queue_.empty() && queue_.top().error_m <= most_m) {
            const Candidate next = queue_.top();
            queue_.pop();
            if (next.version != version_[next.vertex] || mesh_.gone(next.vertex)) continue;
            if (next.target == kNone) {
                weigh(next.vertex, std::max(most_m, allowed_m(request_.last_level)));
                continue;
            }
            const Vertex first = request_.waits_for[next.vertex];
            if (used_as_target_[next.vertex] == level_ || (first != next.vertex && !mesh_.gone(first))) {
                later.push_back(next);
                continue;
            }
            if (!any_slide_will_do_ && !slides_well(next)) {
                refused_[next.vertex].push_back(next.target);
                const Candidate other = best_target(next.vertex, most_m, kNone);
                if (other.target != next.vertex) {
                    queue_.push(other);
                } else {
                    later.push_back({last_error_m_[next.vertex], next.vertex, kNone, next.version});
                }
                continue;
            }
            const auto touched = mesh_.ring(next.vertex);
            apply(next.vertex, next.target, level_);
            for (const Vertex vertex : touched) touch(vertex);
        }
        for (const Candidate& candidate : later) {
            queue_.push(candidate);
            refused_[candidate.vertex].clear();
        }
    }

    /// Queues an inner vertex whose triangles have changed, by the error it had: what it is now is found out
    /// when its turn comes, mostly after some more changes.
    void touch(Vertex v) {
        if (mesh_.gone(v) || request_.fates[v].on_edge) return;
        refused_[v].clear();
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
    /// collapses. Where all ways leave triangles that do not while the edges' vertices are on their way,
    /// those count too for one that will soon be in an edge's way.
    [[nodiscard]] Candidate best_target(Vertex v, float most_m, Vertex excepted) {
        find_ways(v, most_m);
        refused_on_the_way_ = false;
        const Candidate best = best_of_ways(v, most_m, excepted);
        if (best.target != v || !refused_on_the_way_ || !soon_in_the_way(v)) return best;
        const bool any_slide_will_do = std::exchange(any_slide_will_do_, true);
        const Candidate other = best_of_ways(v, most_m, excepted);
        any_slide_will_do_ = any_slide_will_do;
        return other;
    }

    /// Whether one of its triangles folds when the edges' vertices go at one of the next levels.
    [[nodiscard]] bool soon_in_the_way(Vertex v) const {
        for (const std::uint32_t t : mesh_.around(v)) {
            const Triangle& triangle = mesh_.triangle(t);
            for (int level = edges_done_ + 1; level <= edges_done_ + kLevelsAhead; ++level) {
                const PlacedTriangle corners{&places_.at_level(triangle[0], level),
                                             &places_.at_level(triangle[1], level),
                                             &places_.at_level(triangle[2], level)};
                if (!is_empty(corners) && !counterclockwise(corners)) return true;
            }
        }
        return false;
    }

    void find_ways(Vertex v, float most_m) {
        const auto neighbours = mesh_.ring(v);
        ways_.clear();
        for (std::size_t i = 0; i < neighbours.size(); ++i) {
            const auto& later = places_.later(neighbours[i]);
            if (!later.empty() && later.front().level <= edges_done_) continue;
            if (std::find(refused_[v].begin(), refused_[v].end(), neighbours[i]) != refused_[v].end())
                continue;
            const float by_size_m = size_cost_m(v, neighbours[i]);
            if (by_size_m <= most_m && by_size_m < kNever) ways_.push_back({by_size_m, i, neighbours[i]});
        }
        std::sort(ways_.begin(), ways_.end());
    }

    /// Ways are tried by the least they can cost, so that most need not be.
    [[nodiscard]] Candidate best_of_ways(Vertex v, float most_m, Vertex excepted) {
        Candidate best{most_m, v, v, version_[v]};
        std::size_t best_number = std::numeric_limits<std::size_t>::max();
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
    [[nodiscard]] PlacedTriangle corners_after(const Triangle& triangle, Vertex v, Vertex target) const {
        PlacedTriangle corners{};
        for (std::size_t i = 0; i < 3; ++i) corners[i] = &here(triangle[i] == v ? target : triangle[i]);
        return corners;
    }

    /// The error of the level from which the longest side that a collapse would leave around the vertex may
    /// be; kNever when it would fold a triangle.
    [[nodiscard]] float size_cost_m(Vertex v, Vertex target) const {
        constexpr auto kErrorASide = static_cast<float>(kMeshShare * kFinestErrorM / kLevelReachM);
        float longest_m = 0.0F;
        std::size_t count = 0;
        for (const std::uint32_t t : mesh_.around(v)) {
            if (has(mesh_.triangle(t), target)) continue;
            if (count++ == kMostAround) return kNever;
            const auto corners = corners_after(mesh_.triangle(t), v, target);
            if (is_empty(corners)) continue;
            const auto& [a, b, c] = corners;
            if (!counterclockwise(corners)) return kNever;
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
        for (const std::uint32_t t : mesh_.around(v)) {
            if (has(mesh_.triangle(t), way.target)) continue;
            const float error_m = error_after(mesh_.triangle(t), v, way.target, enough_m);
            if (error_m > enough_m) return kNever;
            greatest_m = std::max(greatest_m, error_m);
        }
        for (const std::uint32_t t : mesh_.around(v)) {
            Triangle triangle = mesh_.triangle(t);
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
            const PlacedTriangle corners{&here(triangle[0]), &here(triangle[1]), &here(triangle[2])};
            if (is_empty(corners)) return 0.0F;
            return surface_.error_m(corners[0]->corner, corners[1]->corner, corners[2]->corner, most_m);
        };
        const bool moves = std::any_of(triangle.begin(), triangle.end(),
                                       [&](Vertex corner) { return places_.is_corner(corner); });
        return moves ? measure(enough_m) : errors_.find(triangle, enough_m, measure);
    }

    /// Whether a triangle stays unfolded and within its level's error whenever the edges' vertices go on, and
    /// on their way. Once it does, it does for the levels still to come.
    [[nodiscard]] bool outlasts_edges(const Triangle& triangle) {
        if (places_.later(triangle[0]).empty() && places_.later(triangle[1]).empty() &&
            places_.later(triangle[2]).empty())
            return true;
        if (outlasting_.has(triangle)) return true;
        const bool outlasts = edges_go_on_well(triangle);
        if (outlasts && !any_slide_will_do_) outlasting_.add(triangle);
        return outlasts;
    }

    [[nodiscard]] bool edges_go_on_well(const Triangle& triangle) {
        int level = edges_done_;
        while (true) {
            const int next = places_.next_level(triangle, level);
            if (next == VertexPlaces::kNoLevel) return true;
            level = next;
            const PlacedTriangle corners{&places_.at_level(triangle[0], level),
                                         &places_.at_level(triangle[1], level),
                                         &places_.at_level(triangle[2], level)};
            const bool ends = is_empty(corners);
            if (!ends && !counterclockwise(corners)) return false;
            const float enough_m = std::max(allowed_m(level), least_error_m_);
            if (!ends && surface_.error_m(corners[0]->corner, corners[1]->corner, corners[2]->corner,
                                          enough_m) > enough_m)
                return false;
            SlidingTriangle sliding;
            for (std::size_t i = 0; i < 3; ++i) {
                sliding.from[i] = places_.at_level(triangle[i], level - 1).corner;
                sliding.to[i] = corners[i]->corner;
            }
            if (!any_slide_will_do_ && !tools::slides_well(sliding, surface_, slide_tolerance(level))) {
                refused_on_the_way_ = true;
                return false;
            }
            if (ends) return true;
        }
    }

    /// Where a vertex that is still in the mesh is at this level: only corners of the tile may have slid
    /// away.
    [[nodiscard]] const Placed& here(Vertex v) const {
        return places_.is_corner(v) ? places_.at_level(v, edges_done_) : places_.own(v);
    }

    /// Whether the triangles around a vertex, while it and all that go at this level so far slide, stay
    /// unfolded and within what the level between allows.
    [[nodiscard]] bool slides_well(const Candidate& candidate) const {
        const SlideTolerance tolerance = slide_tolerance(level_);
        const auto around = mesh_.around_before(candidate.vertex);
        return std::all_of(around.begin(), around.end(), [&](std::uint32_t t) {
            SlidingTriangle sliding;
            for (std::size_t i = 0; i < 3; ++i) {
                sliding.from[i] = before_level(mesh_.triangle_before(t)[i]).corner;
                sliding.to[i] = after_level(mesh_.triangle_before(t)[i], candidate).corner;
            }
            return tools::slides_well(sliding, surface_, tolerance);
        });
    }

    [[nodiscard]] const Placed& before_level(Vertex v) const {
        return places_.is_corner(v) ? places_.at_level(v, level_ - 1) : places_.own(v);
    }
    /// When the candidate goes, too.
    [[nodiscard]] const Placed& after_level(Vertex v, const Candidate& candidate) const {
        if (v == candidate.vertex) return here(candidate.target);
        return here(mesh_.gone_level(v) == level_ ? mesh_.target(v) : v);
    }

    void apply(Vertex v, Vertex target, int level) {
        mesh_.collapse(v, target, level);
        used_as_target_[target] = level;
    }

    static constexpr std::size_t kMostAround = 64;

    const CollapseRequest& request_;
    const SampledSurface& surface_;
    int level_ = 0;
    float least_error_m_ = 0.0F;      ///< that is allowed whatever the level, once too many vertices are left
    bool any_slide_will_do_ = false;  ///< how triangles are on the way is not looked at
    bool refused_on_the_way_ = false;  ///< since it was set to false: a way, for the edges' slides
    int edges_done_ = 0;               ///< the level that the edges' vertices have been taken to
    CollapsingMesh mesh_;
    VertexPlaces places_;
    std::vector<std::uint32_t> version_;
    std::vector<std::vector<Vertex>>
        refused_;                      ///< targets to which a vertex does not slide well at this level
    std::vector<float> last_error_m_;  ///< by vertex: of its best collapse when it was last weighed
    std::vector<int> used_as_target_;  ///< the level at which
    std::priority_queue<Candidate, std::vector<Candidate>, std::greater<>> queue_;
    TriangleErrors errors_;
    TriangleSet outlasting_;
    std::vector<Way> ways_;
};

}  // namespace

CollapseResult collapse(const CollapseRequest& request, const SampledSurface& surface) {
    return Collapse{request, surface}.run();
}

}  // namespace eyepoint::tools
