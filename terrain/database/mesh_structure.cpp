#include "terrain/database/mesh_structure.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <tuple>

#include <fmt/format.h>

#include "terrain/database/mesh_gates.hpp"
#include "terrain/database/mesh_places.hpp"

namespace eyepoint::terrain {

namespace {

using Fault = tl::expected<void, std::string>;

constexpr std::array<std::uint16_t, 4> kCorners{0, kBlockCells, kBlockCells* kBlockPosts,
                                                kBlockPosts* kBlockPosts - 1};

Fault check_sizes(const NestedMesh& mesh) {
    const std::size_t named = mesh.posts.size() + mesh.fine_posts.size();
    if (mesh.whole_grid && (named > 0 || !mesh.triangles.empty())) {
        return tl::unexpected(std::string{"a mesh of the whole grid lists posts or triangles"});
    }
    const std::size_t expected = mesh.whole_grid ? kMaxVertices : named;
    if (expected > kMaxVertices || mesh.gone_level.size() != expected || mesh.target.size() != expected) {
        return tl::unexpected(fmt::format("it has {} vertices, {} levels and {} targets", expected,
                                          mesh.gone_level.size(), mesh.target.size()));
    }
    if (mesh.triangles.size() % 3 != 0 || mesh.triangles.size() > 3 * kMaxTriangles) {
        return tl::unexpected(fmt::format("its triangles have {} corners", mesh.triangles.size()));
    }
    return {};
}

Fault check_places(const NestedMesh& mesh) {
    const bool posts_rise = std::ranges::adjacent_find(mesh.posts, std::greater_equal{}) == mesh.posts.end();
    if (!posts_rise || (!mesh.posts.empty() && mesh.posts.back() >= kMaxVertices)) {
        return tl::unexpected(std::string{"its posts do not rise or lie outside the tile"});
    }
    const auto rows_first = [](const NestedMesh::FinePost& post) { return std::tuple{post.y, post.x}; };
    const bool fine_rise = std::ranges::adjacent_find(mesh.fine_posts, std::greater_equal{}, rows_first) ==
                           mesh.fine_posts.end();
    const bool fine_inside = std::ranges::all_of(mesh.fine_posts, [](const NestedMesh::FinePost& post) {
        return post.x <= kPlaceUnits && post.y <= kPlaceUnits &&
               (post.x % kPostUnits != 0 || post.y % kPostUnits != 0);
    });
    if (fine_rise && fine_inside) return {};
    return tl::unexpected(std::string{"its fine posts do not rise, lie outside the tile or on own posts"});
}

Fault check_corners(const NestedMesh& mesh) {
    for (const std::uint16_t corner : kCorners) {
        std::size_t vertex = corner;
        if (!mesh.whole_grid) {
            const auto found = std::ranges::lower_bound(mesh.posts, corner);
            if (found == mesh.posts.end() || *found != corner) {
                return tl::unexpected(fmt::format("corner post {} is not in it", corner));
            }
            vertex = static_cast<std::size_t>(found - mesh.posts.begin());
        }
        if (mesh.gone_level[vertex] != NestedMesh::kStays) {
            return tl::unexpected(
                fmt::format("corner post {} goes at level {}", corner, mesh.gone_level[vertex]));
        }
    }
    return {};
}

Fault check_targets(const NestedMesh& mesh, std::uint8_t last_level) {
    for (std::size_t vertex = 0; vertex < mesh.vertices(); ++vertex) {
        const std::uint8_t level = mesh.gone_level[vertex];
        const std::uint16_t target = mesh.target[vertex];
        if (level == NestedMesh::kStays) {
            if (target == 0) continue;
            return tl::unexpected(fmt::format("vertex {} stays and has target {}", vertex, target));
        }
        if (level > last_level) {
            return tl::unexpected(
                fmt::format("vertex {} goes at level {}, after its last, {}", vertex, level, last_level));
        }
        if (target >= mesh.vertices() || mesh.gone_level[target] <= level) {
            return tl::unexpected(
                fmt::format("vertex {} goes to {}, which is not there any longer", vertex, target));
        }
    }
    return {};
}

Fault check_triangles(const NestedMesh& mesh) {
    for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) {
        const std::uint16_t a = mesh.triangles[i], b = mesh.triangles[i + 1], c = mesh.triangles[i + 2];
        if (a != b && b != c && c != a && std::max({a, b, c}) < mesh.vertices()) continue;
        return tl::unexpected(fmt::format("triangle {} has corners {}, {}, {}", i / 3, a, b, c));
    }
    return {};
}

std::int64_t doubled_area(Place a, Place b, Place c) {
    return std::int64_t{b.x - a.x} * (c.y - a.y) - std::int64_t{b.y - a.y} * (c.x - a.x);
}

}  // namespace

tl::expected<void, std::string> check_structure(const NestedMesh& mesh, std::uint8_t last_level) {
    return check_sizes(mesh)
        .and_then([&] { return check_places(mesh); })
        .and_then([&] { return check_corners(mesh); })
        .and_then([&] { return check_targets(mesh, last_level); })
        .and_then([&] { return check_triangles(mesh); });
}

tl::expected<void, std::string> check_cover(const NestedMesh& mesh) {
    if (mesh.whole_grid) return {};
    const auto places = vertex_places(mesh);
    std::int64_t area = 0;
    std::vector<std::pair<std::uint16_t, std::uint16_t>> edges;
    for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) {
        const std::uint16_t a = mesh.triangles[i], b = mesh.triangles[i + 1], c = mesh.triangles[i + 2];
        const std::int64_t part = doubled_area(places[a], places[b], places[c]);
        // One turned over covers twice what it takes back: the sum tells. (Beside a coarser leaf, and at a
        // corner that has slid on in an ancestor, the compiler leaves a few.)
        area += part;
        edges.insert(edges.end(), {{a, b}, {b, c}, {c, a}});
    }
    std::ranges::sort(edges);
    if (std::ranges::adjacent_find(edges) != edges.end()) {
        return tl::unexpected(std::string{"two triangles lie on one side of an edge"});
    }
    for (const auto& [from, to] : edges) {
        const bool border = (sides_of(places[from]) & sides_of(places[to])) != 0;
        if (border || std::ranges::binary_search(edges, std::pair{to, from})) continue;
        return tl::unexpected(fmt::format("beyond the edge from {} to {} there is no triangle", from, to));
    }
    if (area == 2 * std::int64_t{kPlaceUnits} * kPlaceUnits) return {};
    return tl::unexpected(std::string{"its triangles do not cover the tile once"});
}

std::vector<std::uint16_t> canonical_triangles(const NestedMesh& mesh) {
    std::vector<std::array<std::uint16_t, 3>> sorted;
    sorted.reserve(mesh.triangles.size() / 3);
    for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) {
        std::array<std::uint16_t, 3> corners{mesh.triangles[i], mesh.triangles[i + 1], mesh.triangles[i + 2]};
        std::ranges::rotate(corners, std::ranges::min_element(corners));
        sorted.push_back(corners);
    }
    std::ranges::sort(sorted);
    std::vector<std::uint16_t> result;
    result.reserve(mesh.triangles.size());
    for (const auto& corners : sorted) result.insert(result.end(), corners.begin(), corners.end());
    return result;
}

}  // namespace eyepoint::terrain
