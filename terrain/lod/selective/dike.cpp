#include "terrain/lod/selective/dike.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <utility>

namespace eyepoint::terrain::selective {

namespace {

struct EdgePosts {
    int first = 0;
    int step = 0;
    bool forward = true;  ///< the block's own triangles run along it from lower posts to higher ones
};

EdgePosts posts_of(Edge edge) {
    switch (edge) {
        case Edge::West:
            return {0, kBlockPosts, false};
        case Edge::East:
            return {kBlockCells, kBlockPosts, true};
        case Edge::South:
            return {0, 1, true};
        case Edge::North:
            return {kBlockCells * kBlockPosts, 1, false};
    }
    return {};
}

/// One side's way along its vertices.
class Side {
  public:
    Side(EdgeVertices vertices, int last) : left_(vertices | std::uint64_t{1} << last) {}
    [[nodiscard]] int at() const { return at_; }
    [[nodiscard]] int next() const { return std::countr_zero(left_); }
    [[nodiscard]] bool at_end() const { return left_ == 0; }
    void advance() {
        at_ = next();
        left_ &= left_ - 1;
    }

  private:
    std::uint64_t left_;
    int at_ = 0;
};

/// How far a line between two posts is from the posts between them, at most.
float deviation_m(std::span<const float> heights_m, int a, int b) {
    const auto [first, last] = std::minmax(a, b);
    const auto height_m = [&](int post) { return heights_m[static_cast<std::size_t>(post)]; };
    const float step_m = (height_m(last) - height_m(first)) / static_cast<float>(std::max(last - first, 1));
    float greatest = 0.0F;
    for (int post = first + 1; post < last; ++post) {
        const float line_m = height_m(first) + step_m * static_cast<float>(post - first);
        greatest = std::max(greatest, std::abs(line_m - height_m(post)));
    }
    return greatest;
}

/// Whether the near side goes on next. A side waits where the other one has a vertex, too, until it comes: a
/// dike is in parts between such posts. And it waits while it is ahead and would pass a vertex of the other.
bool near_goes_on(const Side& near, const Side& far, std::uint64_t shared, std::span<const float> heights_m) {
    if (near.at() > far.at() && (shared >> near.at() & 1U) != 0) return false;
    if (far.at() > near.at() && (shared >> far.at() & 1U) != 0) return true;
    if (near.at() > far.at() && near.next() > far.next()) return false;
    if (far.at() > near.at() && far.next() > near.next()) return true;
    const float by_near_m = deviation_m(heights_m, near.next(), far.at()),
                by_far_m = deviation_m(heights_m, near.at(), far.next());
    return by_near_m == by_far_m ? near.next() <= far.next() : by_near_m < by_far_m;
}

/// Calls `triangle` with three posts for each triangle of a dike. A walk along the strip: every edge of
/// either side belongs to one triangle of it, whose third corner is where the other side has got to.
template <typename Triangle>
void walk_dike(EdgeVertices near_vertices, EdgeVertices far_vertices, std::span<const float> heights_m,
               Triangle triangle) {
    if (near_vertices == far_vertices) return;
    const int last = static_cast<int>(heights_m.size()) - 1;
    const std::uint64_t shared = (near_vertices & far_vertices) | std::uint64_t{1} << last;
    Side near(near_vertices, last), far(far_vertices, last);
    while (!near.at_end() || !far.at_end()) {
        if (near_goes_on(near, far, shared, heights_m)) {
            if (near.at() != far.at() && near.next() != far.at()) triangle(near.next(), near.at(), far.at());
            near.advance();
        } else {
            if (near.at() != far.at() && far.next() != near.at()) triangle(far.at(), far.next(), near.at());
            far.advance();
        }
    }
}

/// Puts a zero behind each of the low 16 bits.
std::uint32_t spread(std::uint32_t bits) {
    bits = (bits | bits << 8) & 0x00ff'00ffU;
    bits = (bits | bits << 4) & 0x0f0f'0f0fU;
    bits = (bits | bits << 2) & 0x3333'3333U;
    return (bits | bits << 1) & 0x5555'5555U;
}

}  // namespace

std::vector<DikeTriangle> dike(EdgeVertices near, EdgeVertices far, std::span<const float> heights_m) {
    std::vector<DikeTriangle> triangles;
    walk_dike(near, far, heights_m, [&](int a, int b, int c) { triangles.push_back({a, b, c}); });
    return triangles;
}

EdgeVertices half_of_edge(EdgeVertices vertices, int half) {
    return spread(vertices >> (half * kBlockCells / 2) & 0xfffeU);
}

void append_dike(Edge edge, EdgeVertices near, EdgeVertices far, const BlockData& block,
                 std::vector<std::uint16_t>& indices) {
    if (near == far) return;
    const EdgePosts posts = posts_of(edge);
    const auto vertex = [&](int post) { return posts.first + post * posts.step; };
    std::array<float, kBlockPosts> heights_m{};
    for (int post = 0; post < kBlockPosts; ++post)
        heights_m[static_cast<std::size_t>(post)] =
            block.height_m(vertex(post) / kBlockPosts, vertex(post) % kBlockPosts);
    walk_dike(near, far, heights_m, [&](int a, int b, int c) {
        if (!posts.forward) std::swap(a, b);
        for (const int post : {a, b, c}) indices.push_back(static_cast<std::uint16_t>(vertex(post)));
    });
}

void append_dikes(const FarSides& far, std::span<const EdgeVertices, 4> own, const BlockData& block,
                  std::vector<std::uint16_t>& indices) {
    for (std::size_t edge = 0; edge < far.size(); ++edge)
        if (far[edge] != 0) append_dike(kEdges[edge], own[edge], far[edge] & ~kDike, block, indices);
}

}  // namespace eyepoint::terrain::selective
