#include "terrain/lod/selective/dike.hpp"

#include <algorithm>
#include <map>
#include <random>
#include <utility>

#include <gtest/gtest.h>

#include "terrain/lod/selective/dependency_hierarchy.hpp"

namespace eyepoint::terrain::selective {
namespace {

using DirectedEdges = std::map<std::pair<int, int>, int>;

void add(DirectedEdges& edges, int from, int to) { ++edges[{from, to}]; }

bool is_vertex(EdgeVertices vertices, int post, int cells) {
    return post == 0 || post == cells || (vertices >> post & 1U) != 0;
}

/// Edges of a side's border line, from lower posts to higher ones.
std::vector<std::pair<int, int>> line(EdgeVertices vertices, int cells) {
    std::vector<std::pair<int, int>> edges;
    for (int post = 1, before = 0; post <= cells; ++post) {
        if (!is_vertex(vertices, post, cells)) continue;
        edges.emplace_back(before, post);
        before = post;
    }
    return edges;
}

/// With the two blocks' own triangles on both sides of it, every edge is in two triangles, once in each
/// direction.
void expect_watertight(const std::vector<DikeTriangle>& dike, EdgeVertices near, EdgeVertices far,
                       int cells) {
    DirectedEdges edges;
    for (const DikeTriangle& triangle : dike) {
        for (std::size_t c = 0; c < 3; ++c) {
            EXPECT_NE(triangle[c], triangle[(c + 1) % 3]);
            add(edges, triangle[c], triangle[(c + 1) % 3]);
        }
    }
    for (const auto& [from, to] : line(near, cells)) add(edges, from, to);
    for (const auto& [from, to] : line(far, cells)) add(edges, to, from);
    for (const auto& [edge, count] : edges) {
        EXPECT_EQ(count, 1) << "near " << near << ", far " << far;
        EXPECT_TRUE(edges.contains({edge.second, edge.first})) << "near " << near << ", far " << far;
    }
}

/// The complete triangulation between two rows of posts, every post collapsed to the vertex of its side
/// before it, triangles without area left out.
std::vector<DikeTriangle> collapsed_strip(EdgeVertices near, EdgeVertices far, int cells) {
    const auto collapsed = [&](EdgeVertices vertices, int post) {
        while (!is_vertex(vertices, post, cells)) --post;
        return post;
    };
    std::vector<DikeTriangle> triangles;
    const auto keep = [&](int a, int b, int c) {
        if (a != b && b != c && c != a) triangles.push_back({a, b, c});
    };
    for (int post = 0; post < cells; ++post) {
        const int near_at = collapsed(near, post), near_next = collapsed(near, post + 1),
                  far_at = collapsed(far, post), far_next = collapsed(far, post + 1);
        keep(near_next, near_at, far_at);
        keep(far_at, far_next, near_next);
    }
    return triangles;
}

TEST(Dike, IsWatertightForEveryPairOfSelectionsOfANinePostEdge) {
    constexpr int kCells = 8;
    constexpr EdgeVertices kEnd = 1U << kCells;
    const std::vector<float> rough{0.0F, 9.0F, 4.0F, -3.0F, 7.0F, 8.0F, -6.0F, 1.0F, 5.0F};
    std::size_t triangles = 0;
    for (EdgeVertices near = 0; near < kEnd; near += 2) {
        for (EdgeVertices far = 0; far < kEnd; far += 2) {
            const auto triangles_here = dike(near, far, rough);
            expect_watertight(triangles_here, near, far, kCells);
            triangles += triangles_here.size();
        }
    }
    // Of two random selections one in two vertices is in one of them alone, and adds a triangle.
    EXPECT_EQ(triangles, 128U * 128U * 7U / 2U);
}

/// Where the ground is even, posts collapse into the vertex before them.
TEST(Dike, IsTheCompleteTriangulationSimplifiedByEdgeCollapse) {
    constexpr int kCells = 8;
    const std::vector<float> flat(kCells + 1, 0.0F);
    for (EdgeVertices near = 0; near < 256; near += 2) {
        for (EdgeVertices far = 0; far < 256; far += 2) {
            auto made = dike(near, far, flat), expected = collapsed_strip(near, far, kCells);
            std::sort(made.begin(), made.end());
            std::sort(expected.begin(), expected.end());
            EXPECT_EQ(made, expected) << "near " << near << ", far " << far;
        }
    }
}

/// The near line 0 to 4; the far side goes up and down across it. A side from 0 to 3 would be farther
/// above post 2 than one from 2 to 4 is below post 3.
TEST(Dike, SliversKeepNearThePostsTheyPass) {
    const std::vector<float> heights_m{0.0F, 1.0F, 2.0F, 11.0F, 10.0F};
    const auto triangles = dike(0U, 1U << 2 | 1U << 3, heights_m);
    const std::vector<DikeTriangle> expected{{4, 0, 2}, {2, 3, 4}};
    EXPECT_EQ(triangles, expected);
}

TEST(Dike, HalfOfAnEdgeHasItsVerticesAsEveryOtherPost) {
    EXPECT_EQ(half_of_edge(1U << 1 | 1U << 15, 0), 1U << 2 | 1U << 30);
    EXPECT_EQ(half_of_edge(1U << 17 | 1U << 31, 1), 1U << 2 | 1U << 30);
    EXPECT_EQ(half_of_edge(1U << 16, 0), 0U) << "an end of both halves";
    EXPECT_EQ(half_of_edge(1U << 16, 1), 0U);
    EXPECT_EQ(half_of_edge(0xffff'fffe, 0), 0x5555'5554U);
}

/// Two finer blocks beside a coarser one, whose middle post need not be a vertex: with the dike up to the
/// middle, all three border lines meet.
TEST(Dike, WhereBlocksOfTwoDepthsMeetThreeDikesMakeItWhole) {
    std::vector<float> heights_m(kBlockPosts);
    std::mt19937 random(1);
    for (float& height_m : heights_m) height_m = std::uniform_real_distribution<float>(0.0F, 90.0F)(random);
    for (const EdgeVertices coarse : {0U, 1U << 5, 1U << 16, 1U << 3 | 1U << 20, 0xffff'fffeU}) {
        for (const EdgeVertices first : {0U, 1U << 7, 0x1234'5678U}) {
            const EdgeVertices second = first << 1 ^ 0x40'0040U;
            // On posts of the finer blocks, 0 to 64; the middle is 32.
            DirectedEdges edges;
            const auto add_line = [&](EdgeVertices vertices, int scale, int offset, bool forward) {
                for (const auto& [from, to] : line(vertices, kBlockCells)) {
                    const int a = from * scale + offset, b = to * scale + offset;
                    forward ? add(edges, a, b) : add(edges, b, a);
                }
            };
            const auto add_dike = [&](EdgeVertices near, EdgeVertices far, int scale, int offset,
                                      bool turned) {
                for (DikeTriangle triangle : dike(near, far, heights_m)) {
                    if (turned) std::swap(triangle[0], triangle[1]);
                    for (std::size_t c = 0; c < 3; ++c)
                        add(edges, triangle[c] * scale + offset, triangle[(c + 1) % 3] * scale + offset);
                }
            };
            add_line(coarse, 2, 0, true);
            add_dike(coarse, coarse | kMiddleVertex, 2, 0, false);
            for (int half = 0; half < 2; ++half) {
                const EdgeVertices fine = half == 0 ? first : second;
                add_line(fine, 1, 32 * half, false);
                add_dike(fine, half_of_edge(coarse, half), 1, 32 * half, true);
            }
            for (const auto& [edge, count] : edges) {
                EXPECT_EQ(count, 1);
                EXPECT_TRUE(edges.contains({edge.second, edge.first})) << edge.first << " to " << edge.second;
            }
        }
    }
}

/// A block's own triangles run counterclockwise around it; its dikes close them on every edge.
TEST(Dike, OfABlockRunsAgainstTheBlocksOwnTriangles) {
    const EdgeVertices near = 1U << 8, far = 1U << 8 | 1U << 20;
    for (const Edge edge : kEdges) {
        std::vector<std::uint16_t> indices;
        append_dike(edge, near, far, BlockData{}, indices);
        ASSERT_EQ(indices.size(), 3U);
        const auto place = [&](std::size_t c) {
            const int row = indices[c] / kBlockPosts, column = indices[c] % kBlockPosts;
            const bool upright = edge == Edge::West || edge == Edge::East;
            const int across = upright ? column : row;
            EXPECT_EQ(across, edge == Edge::East || edge == Edge::North ? kBlockCells : 0);
            return upright ? row : column;
        };
        bool against = false;
        for (std::size_t c = 0; c < 3; ++c) {
            const bool forward = edge == Edge::South || edge == Edge::East;
            against = against || (forward ? place(c) == kBlockCells && place((c + 1) % 3) == 8
                                          : place(c) == 8 && place((c + 1) % 3) == kBlockCells);
        }
        EXPECT_TRUE(against);
    }
}

}  // namespace
}  // namespace eyepoint::terrain::selective
