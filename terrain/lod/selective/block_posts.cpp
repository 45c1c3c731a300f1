#include "terrain/lod/selective/block_posts.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <glm/geometric.hpp>

#include "terrain/lod/triangle_arc.hpp"

namespace eyepoint::terrain::selective {

namespace {

class Heights {
  public:
    explicit Heights(const BlockData& data) {
        for (int post = 0; post < kBlockVertices; ++post)
            heights_m_[static_cast<std::size_t>(post)] =
                data.height_m(post / kBlockPosts, post % kBlockPosts);
    }

    [[nodiscard]] float at(int post) const { return heights_m_[static_cast<std::size_t>(post)]; }

    /// Of the middle of the triangle's base from the mean of the base's ends.
    [[nodiscard]] float delta_m(const TreeTriangle& triangle) const {
        return std::abs(at(middle_post(triangle)) - base_middle_m(triangle));
    }

    /// Greatest distance along the vertical of a post in a triangle, which is of a level, from its plane.
    /// Triangles of even levels have their legs along the grid; those of odd levels have their base along it.
    [[nodiscard]] float deviation_m(const TreeTriangle& triangle, int level) const {
        const auto [apex, left, right] = triangle.vertices;
        const int cells = kBlockCells >> ((level + 1) / 2);
        if (level % 2 == 0)
            return deviation_m({apex, (left - apex) / cells, (right - apex) / cells, cells, false},
                               {at(apex), at(left) - at(apex), at(right) - at(apex)});
        const int middle = middle_post(triangle);
        const float base_m = base_middle_m(triangle);
        return deviation_m({apex, (middle - apex) / cells, (left - middle) / cells, cells, true},
                           {at(apex), base_m - at(apex), at(left) - base_m});
    }

  private:
    /// Posts apex + i u + j v, 0 <= i <= cells and 0 <= j <= cells - i or, in a fan, -i <= j <= i.
    struct Posts {
        int apex = 0, u = 0, v = 0;
        int cells = 0;
        bool fan = false;
    };
    /// Of a plane over them: height at the apex, rise over all cells of u and of v.
    struct Plane {
        float apex_m = 0.0F, rise_u_m = 0.0F, rise_v_m = 0.0F;
    };

    [[nodiscard]] float deviation_m(const Posts& posts, const Plane& plane) const {
        const float step_u_m = plane.rise_u_m / static_cast<float>(posts.cells),
                    step_v_m = plane.rise_v_m / static_cast<float>(posts.cells);
        float greatest = 0.0F;
        for (int i = 0; i <= posts.cells; ++i) {
            const float row_m = plane.apex_m + step_u_m * static_cast<float>(i);
            const int last = posts.fan ? i : posts.cells - i;
            const int first = posts.fan ? -i : 0;
            const float* post_m =
                &heights_m_[static_cast<std::size_t>(posts.apex + i * posts.u + first * posts.v)];
            for (int j = first; j <= last; ++j, post_m += posts.v)
                greatest = std::max(greatest, std::abs(*post_m - (row_m + step_v_m * static_cast<float>(j))));
        }
        return greatest;
    }

    [[nodiscard]] float base_middle_m(const TreeTriangle& triangle) const {
        return (at(triangle.vertices[1]) + at(triangle.vertices[2])) * 0.5F;
    }

    std::array<float, kBlockVertices> heights_m_{};
};

/// Fills in a block's posts triangle by triangle; each has the vertex of the middle of its base.
class Maker {
  public:
    Maker(const Block& block, float unseen_m) : block_(block), heights_(block.data), unseen_m_(unseen_m) {
        posts_.origin = block.vertices[kBlockVertices / 2].position();
        posts_.up = glm::vec3{glm::normalize(posts_.origin)};
        for (int level = 0; level < kLevels; ++level)
            arcs_m_[static_cast<std::size_t>(level)] =
                static_cast<float>(arc_height_m(block.data.tile.depth, level));
        const auto vertices = hierarchy_.vertices();
        for (std::size_t rank = 0; rank < kRanks; ++rank) {
            const glm::vec3 at = from_origin_m(vertices[rank].post);
            posts_.x[rank] = at.x;
            posts_.y[rank] = at.y;
            posts_.z[rank] = at.z;
        }
        for (const TreeTriangle& root : hierarchy_.roots()) add(root, 0);
        for (std::size_t rank = 0; rank < kRanks; ++rank) {
            const HierarchyVertex& vertex = vertices[rank];
            for (std::size_t t = 0; t < vertex.triangle_count; ++t) add(vertex.triangles[t], vertex.level);
        }
    }

    [[nodiscard]] const BlockPosts& posts() const { return posts_; }

  private:
    void add(const TreeTriangle& triangle, int level) {
        const Rank rank = triangle.middle;
        if (rank == kNoRank) return;
        const float deviation_m = heights_.deviation_m(triangle, level);
        const float arc_m = arcs_m_[static_cast<std::size_t>(level)];
        const glm::vec3 middle{posts_.x[rank], posts_.y[rank], posts_.z[rank]};
        float radius_m = 0.0F;
        for (const std::uint16_t corner : triangle.vertices)
            radius_m = std::max(radius_m, glm::distance(middle, from_origin_m(corner)));
        posts_.delta_m[rank] = heights_.delta_m(triangle);
        posts_.arc_m[rank] = arc_m;
        posts_.bound_m[rank] = std::max(posts_.bound_m[rank], deviation_m + unseen_m_ + arc_m);
        posts_.radius_m[rank] = std::max(posts_.radius_m[rank], radius_m + deviation_m);
    }

    [[nodiscard]] glm::vec3 from_origin_m(std::uint16_t post) const {
        return glm::vec3{block_.vertices[post].position() - posts_.origin};
    }

    const DependencyHierarchy& hierarchy_ = DependencyHierarchy::of_block();
    const Block& block_;
    Heights heights_;
    float unseen_m_;
    std::array<float, kLevels> arcs_m_{};
    BlockPosts posts_;
};

}  // namespace

BlockPosts block_posts(const Block& block, float unseen_m) { return Maker(block, unseen_m).posts(); }

}  // namespace eyepoint::terrain::selective
