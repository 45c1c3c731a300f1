/// Nested meshes for tests, like those of a compiler: random rough ground whose grid is collapsed vertex by
/// vertex, the least error first.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <queue>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "terrain/database/database.hpp"
#include "terrain/database/mesh_places.hpp"
#include "terrain/lod/error_level.hpp"

namespace eyepoint::terrain {

/// Heights of a square of 2^k + 1 posts a side, quanta of 1/16 m: midpoint displacement, a random fraction of
/// it flat.
inline std::vector<int> random_ground(int posts, std::uint32_t seed) {
    std::mt19937 random{seed};
    std::vector<int> quanta(static_cast<std::size_t>(posts * posts));
    const auto at = [&](int x, int y) -> int& { return quanta[static_cast<std::size_t>(y * posts + x)]; };
    double rough = 8'000.0 + static_cast<double>(random() % 8'000);
    for (int step = posts - 1; step > 1; step /= 2, rough *= 0.5) {
        std::normal_distribution<double> displace{0.0, rough};
        const int half = step / 2;
        for (int y = 0; y < posts; y += half) {
            for (int x = 0; x < posts; x += half) {
                const int low_x = x / step * step, low_y = y / step * step;
                if (x == low_x && y == low_y) continue;
                const int high_x = x == low_x ? x : low_x + step, high_y = y == low_y ? y : low_y + step;
                const double relief = std::abs(at(low_x, low_y)) / 16'000.0 + 0.1;
                at(x, y) =
                    static_cast<int>((at(low_x, low_y) + at(high_x, high_y)) / 2 + relief * displace(random));
            }
        }
    }
    const int sea = quanta[random() % quanta.size()] - 4'000;
    for (int& height : quanta) height = std::max(height, sea);
    return quanta;
}

/// Collapses the grid of a square of ground. Vertices of its sides go along them, the corners stay.
class Collapse {
  public:
    using Vertex = std::uint16_t;
    using Corners = std::array<Vertex, 3>;

    Collapse(int posts, std::vector<int> quanta)
        : posts_(posts),
          quanta_(std::move(quanta)),
          around_(quanta_.size()),
          carried_(quanta_.size(), 0.0),
          changes_(quanta_.size(), 0),
          alive_(quanta_.size()) {
        for (int y = 0; y + 1 < posts; ++y) {
            for (int x = 0; x + 1 < posts; ++x) {
                const Vertex sw = number(x, y), se = number(x + 1, y), nw = number(x, y + 1),
                             ne = number(x + 1, y + 1);
                add({sw, se, ne});
                add({sw, ne, nw});
            }
        }
        for (std::size_t v = 0; v < quanta_.size(); ++v) consider(static_cast<Vertex>(v));
    }

    struct Step {
        Vertex gone = 0;
        Vertex target = 0;
        double error_m = 0.0;  ///< never less than a step's before it
    };
    [[nodiscard]] std::vector<Step> down_to(std::size_t vertices) {
        std::vector<Step> steps;
        while (alive_ > vertices && !queue_.empty()) {
            const Choice choice = queue_.top();
            queue_.pop();
            if (choice.change != changes_[choice.gone] || around_[choice.gone].empty()) continue;
            error_m_ = std::max(error_m_, choice.cost_m);
            steps.push_back({choice.gone, choice.target, error_m_});
            collapse(choice);
        }
        return steps;
    }
    [[nodiscard]] std::vector<Corners> triangles() const {
        std::set<Corners> all;
        for (const auto& around : around_) all.insert(around.begin(), around.end());
        return {all.begin(), all.end()};
    }
    [[nodiscard]] bool is_alive(std::size_t vertex) const { return !around_[vertex].empty(); }
    [[nodiscard]] int height_quanta(std::size_t vertex) const { return quanta_[vertex]; }
    [[nodiscard]] Place place(std::size_t vertex) const {
        const auto posts = static_cast<std::size_t>(posts_);
        const auto units = static_cast<std::int32_t>(kPlaceUnits) / (posts_ - 1);
        return {static_cast<std::int32_t>(vertex % posts) * units,
                static_cast<std::int32_t>(vertex / posts) * units};
    }

  private:
    struct Choice {
        double cost_m = 0.0;
        Vertex gone = 0;
        Vertex target = 0;
        int change = 0;
        bool operator<(const Choice& other) const { return cost_m > other.cost_m; }
    };

    [[nodiscard]] Vertex number(int x, int y) const { return static_cast<Vertex>(y * posts_ + x); }
    void add(const Corners& corners) {
        for (const Vertex v : corners) around_[v].push_back(corners);
    }

    [[nodiscard]] double area(Vertex a, Vertex b, Vertex c) const {
        const Place p = place(a), q = place(b), r = place(c);
        return static_cast<double>(q.x - p.x) * (r.y - p.y) - static_cast<double>(q.y - p.y) * (r.x - p.x);
    }

    /// How far the ground at a vertex gets from the mesh when it goes to a neighbour; infinite where a
    /// triangle would turn over.
    [[nodiscard]] double cost_m(Vertex gone, Vertex target) const {
        double error_m = 0.0;
        for (Corners corners : around_[gone]) {
            if (std::ranges::find(corners, target) != corners.end()) continue;
            std::ranges::replace(corners, gone, target);
            const auto [a, b, c] = corners;
            const double whole = area(a, b, c);
            if (whole <= 0.0) return std::numeric_limits<double>::infinity();
            const double wa = area(gone, b, c) / whole, wb = area(a, gone, c) / whole, wc = 1.0 - wa - wb;
            if (std::min({wa, wb, wc}) < -1e-9) continue;
            error_m = std::abs(wa * quanta_[a] + wb * quanta_[b] + wc * quanta_[c] - quanta_[gone]) / 16.0;
        }
        return error_m + carried_[gone];
    }

    void consider(Vertex vertex) {
        const std::uint8_t sides = sides_of(place(vertex));
        if ((sides & (sides - 1)) != 0) return;
        Choice best{std::numeric_limits<double>::infinity(), vertex, vertex, ++changes_[vertex]};
        for (const Corners& corners : around_[vertex]) {
            for (const Vertex target : corners) {
                if (target == vertex || (sides & ~sides_of(place(target))) != 0) continue;
                const double cost = cost_m(vertex, target);
                if (cost < best.cost_m) best.cost_m = cost, best.target = target;
            }
        }
        if (best.target != vertex) queue_.push(best);
    }

    void collapse(const Choice& choice) {
        std::set<Vertex> ring;
        for (const Corners& old : std::exchange(around_[choice.gone], {})) {
            Corners corners = old;
            const bool vanishes = std::ranges::find(old, choice.target) != old.end();
            std::ranges::replace(corners, choice.gone, choice.target);
            for (const Vertex v : old) {
                if (v == choice.gone) continue;
                ring.insert(v);
                std::erase(around_[v], old);
                if (!vanishes) around_[v].push_back(corners);
            }
            if (!vanishes) around_[choice.target].push_back(corners);
        }
        --alive_;
        for (const Vertex v : ring) carried_[v] = std::max(carried_[v], choice.cost_m);
        for (const Vertex v : ring) consider(v);
    }

    int posts_ = 0;
    std::vector<int> quanta_;
    std::vector<std::vector<Corners>> around_;  ///< triangles by vertex
    std::vector<double> carried_;
    std::vector<int> changes_;
    std::priority_queue<Choice> queue_;
    std::size_t alive_ = 0;
    double error_m_ = 0.0;
};

struct LevelledMesh {
    NestedMesh mesh;
    std::uint8_t first_level = 0;
    std::uint8_t last_level = 0;
};

/// The mesh of a tile on random ground of so many posts a side (33: of a tile without children), from the
/// level at which at most `first` vertices are left to the one at which at most `last` are.
inline LevelledMesh collapsed_mesh(int posts, std::size_t first, std::size_t last, std::uint32_t seed) {
    Collapse collapse{posts, random_ground(posts, seed)};
    LevelledMesh result;
    const auto before = collapse.down_to(first);
    if (!before.empty()) result.first_level = level_of_error(before.back().error_m);
    NestedMesh& mesh = result.mesh;
    mesh.whole_grid = posts == kBlockPosts && before.empty();
    const auto count = static_cast<std::size_t>(posts) * static_cast<std::size_t>(posts);
    std::vector<std::uint16_t> number(count), own, fine;
    for (std::size_t v = 0; v < count; ++v) {
        if (!collapse.is_alive(v)) continue;
        const Place place = collapse.place(v);
        const bool is_own = place.x % kPostUnits == 0 && place.y % kPostUnits == 0;
        (is_own ? own : fine).push_back(static_cast<std::uint16_t>(v));
    }
    for (const std::uint16_t v : own) {
        const Place place = collapse.place(v);
        number[v] = static_cast<std::uint16_t>(mesh.posts.size());
        mesh.posts.push_back(
            static_cast<std::uint16_t>(place.y / kPostUnits * kBlockPosts + place.x / kPostUnits));
    }
    for (const std::uint16_t v : fine) {
        const Place place = collapse.place(v);
        number[v] = static_cast<std::uint16_t>(own.size() + mesh.fine_posts.size());
        mesh.fine_posts.push_back({static_cast<std::uint32_t>(place.x), static_cast<std::uint32_t>(place.y),
                                   static_cast<float>(collapse.height_quanta(v)) / 16.0F});
    }
    for (const auto& corners : collapse.triangles()) {
        for (const std::uint16_t v : corners) mesh.triangles.push_back(number[v]);
    }
    if (mesh.whole_grid) mesh.posts.clear(), mesh.triangles.clear();

    mesh.gone_level.assign(own.size() + fine.size(), NestedMesh::kStays);
    mesh.target.assign(own.size() + fine.size(), 0);
    const auto steps = collapse.down_to(last);
    for (const auto& step : steps) {
        const std::uint8_t level = std::max<std::uint8_t>(level_of_error(step.error_m),
                                                          static_cast<std::uint8_t>(result.first_level + 1));
        mesh.gone_level[number[step.gone]] = level;
        mesh.target[number[step.gone]] = number[step.target];
        result.last_level = std::max(result.last_level, level);
    }
    result.last_level = std::max(result.last_level, result.first_level);
    // A target that goes at the same level is passed on to its own.
    for (std::size_t v = 0; v < mesh.vertices(); ++v) {
        while (mesh.gone_level[v] != NestedMesh::kStays &&
               mesh.gone_level[mesh.target[v]] == mesh.gone_level[v])
            mesh.target[v] = mesh.target[mesh.target[v]];
    }
    return result;
}

}  // namespace eyepoint::terrain
