#include "terrain/lod/hyperblock/vertex_selection.hpp"

#include <algorithm>
#include <cstddef>

#include <glm/geometric.hpp>

namespace eyepoint::terrain::hyperblock {

using selective::BorderSelection;
using selective::DependencyHierarchy;
using selective::HierarchyVertex;
using selective::kNoRank;
using selective::kRanks;
using selective::Rank;
using selective::TreeTriangle;

namespace {

/// Spheres are so much larger, relatively, than those they hold, that this is seen in floats from anywhere
/// the points are looked at from.
constexpr float kRounding = 1.001F;

class Refinement {
  public:
    Refinement(const PointSet& points, const NestedPoints& nested, const EyeInTile& eye,
               const ScreenScale& scale, std::vector<std::uint16_t>& indices)
        : points_(points), nested_(nested), eye_(eye), scale_(scale), indices_(indices) {}

    /// inside: all that is below the triangle is in the view volume.
    void refine(const TreeTriangle& triangle, bool inside) {
        if (triangle.middle == kNoRank || !selected(triangle.middle, inside)) {
            indices_.insert(indices_.end(), triangle.vertices.begin(), triangle.vertices.end());
            return;
        }
        const HierarchyVertex& vertex = vertices_[triangle.middle];
        if (vertex.edge != selective::kInside) border_[vertex.edge] |= vertex.border_bit;
        const std::size_t first = vertex.triangles[0].vertices[1] == triangle.vertices[0] ? 0 : 2;
        refine(vertex.triangles[first], inside);
        refine(vertex.triangles[first + 1], inside);
    }

    [[nodiscard]] const BorderSelection& border() const { return border_; }

  private:
    [[nodiscard]] bool selected(Rank rank, bool& inside) const {
        if (!points_.vertices[rank]) return false;
        const NestedPoint& point = nested_[rank];
        const float reach_m = scale_.reach_m(point);
        if (reach_m <= eye_.distance_m(point.bounds)) return false;
        if (inside) return true;
        const EyeInTile::Lies lies = eye_.lies(point.bounds, scale_);
        inside = lies == EyeInTile::Lies::Inside;
        return lies != EyeInTile::Lies::Outside;
    }

    const HierarchyVertex* vertices_ = DependencyHierarchy::of_block().vertices().data();
    const PointSet& points_;
    const NestedPoints& nested_;
    const EyeInTile& eye_;
    const ScreenScale& scale_;
    std::vector<std::uint16_t>& indices_;
    BorderSelection border_{};
};

}  // namespace

/// Finest level first: what depends on a point comes before it.
NestedPoints nested_points(const selective::BlockPosts& posts, const PointSet& points) {
    NestedPoints nested;
    const auto vertices = DependencyHierarchy::of_block().vertices();
    for (std::size_t rank = 0; rank < kRanks; ++rank) {
        NestedPoint& point = nested[rank];
        point.bounds.centre_m = {posts.x[rank], posts.y[rank], posts.z[rank]};
        point.bounds.radius_m = std::max(point.bounds.radius_m, posts.radius_m[rank]);
        point.error_m = std::max(point.error_m, posts.bound_m[rank]);
        point.arc_m = std::max(point.arc_m, posts.arc_m[rank]);
        if (!points.vertices[rank]) continue;
        for (const Rank parent : vertices[rank].parents) {
            if (parent == kNoRank) continue;
            NestedPoint& above = nested[parent];
            const glm::vec3 at{posts.x[parent], posts.y[parent], posts.z[parent]};
            above.bounds.radius_m =
                std::max(above.bounds.radius_m,
                         kRounding * (glm::distance(at, point.bounds.centre_m) + point.bounds.radius_m));
            above.error_m = std::max(above.error_m, point.error_m);
            above.arc_m = std::max(above.arc_m, point.arc_m);
        }
    }
    return nested;
}

BorderSelection select_vertices(const PointSet& points, const NestedPoints& nested, const EyeInTile& eye,
                                const ScreenScale& scale, std::vector<std::uint16_t>& indices) {
    Refinement refinement(points, nested, eye, scale, indices);
    for (const TreeTriangle& root : DependencyHierarchy::of_block().roots()) refinement.refine(root, false);
    return refinement.border();
}

}  // namespace eyepoint::terrain::hyperblock
