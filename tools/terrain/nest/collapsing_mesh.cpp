#include "tools/terrain/nest/collapsing_mesh.hpp"

#include <algorithm>
#include <utility>

#include "terrain/database/database.hpp"

namespace eyepoint::tools {

using terrain::NestedMesh;

CollapsingMesh::CollapsingMesh(const TriangleMesh& mesh)
    : triangles_(mesh.triangles), dead_(triangles_.size(), false), around_(mesh.vertices.size()) {
    result_.gone_level.assign(around_.size(), NestedMesh::kStays);
    result_.target.assign(around_.size(), 0);
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
        for (const Vertex corner : triangles_[t]) around_[corner].push_back(static_cast<std::uint32_t>(t));
    }
}

bool CollapsingMesh::gone(Vertex v) const { return result_.gone_level[v] != NestedMesh::kStays; }

std::size_t CollapsingMesh::vertices_left() const {
    return static_cast<std::size_t>(
        std::count(result_.gone_level.begin(), result_.gone_level.end(), NestedMesh::kStays));
}

std::vector<CollapsingMesh::Vertex> CollapsingMesh::ring(Vertex v) const {
    std::vector<Vertex> vertices;
    for (const std::uint32_t t : around_[v]) {
        for (const Vertex corner : triangles_[t]) {
            if (corner != v && std::find(vertices.begin(), vertices.end(), corner) == vertices.end())
                vertices.push_back(corner);
        }
    }
    return vertices;
}

std::ptrdiff_t CollapsingMesh::shared_triangles(Vertex a, Vertex b) const {
    return std::count_if(around_[a].begin(), around_[a].end(),
                         [&](std::uint32_t t) { return has(triangles_[t], b); });
}

void CollapsingMesh::collapse(Vertex v, Vertex target, int level) {
    result_.gone_level[v] = static_cast<std::uint8_t>(level);
    result_.target[v] = target;
    for (const std::uint32_t t : around_[v]) {
        Triangle& triangle = triangles_[t];
        if (has(triangle, target)) {
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

void CollapsingMesh::follow_targets() {
    for (std::size_t v = 0; v < result_.target.size(); ++v) {
        if (result_.gone_level[v] == NestedMesh::kStays) continue;
        Vertex& target = result_.target[v];
        while (result_.gone_level[target] <= result_.gone_level[v]) target = result_.target[target];
    }
}

void CollapsingMesh::remember() {
    before_ = triangles_;
    first_before_.assign(around_.size() + 1, 0);
    around_before_.clear();
    for (std::size_t v = 0; v < around_.size(); ++v) {
        around_before_.insert(around_before_.end(), around_[v].begin(), around_[v].end());
        first_before_[v + 1] = around_before_.size();
    }
}

std::span<const std::uint32_t> CollapsingMesh::around_before(Vertex v) const {
    return std::span{around_before_}.subspan(first_before_[v], first_before_[v + 1U] - first_before_[v]);
}

CollapseResult CollapsingMesh::take() {
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
        if (!dead_[t]) result_.coarsest.push_back(triangles_[t]);
    }
    return std::move(result_);
}

}  // namespace eyepoint::tools
