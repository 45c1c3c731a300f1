#include "terrain/lod/nested_motion.hpp"

#include <cmath>
#include <set>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "terrain/geodesy/earth.hpp"
#include "terrain/lod/error_level.hpp"
#include "tests/support/analytic_terrain.hpp"
#include "tests/terrain/lod/nested_mesh.hpp"
#include "tests/terrain/lod/pattern_planet.hpp"

namespace eyepoint::terrain {
namespace {

using testing::bits_of;

constexpr double kLatitudeDeg = 46.5, kLongitudeDeg = 8.25;

/// The tiles over one place, and those beside them, loaded down to a depth.
class NestedMotionTest : public ::testing::Test {
  protected:
    static constexpr std::uint32_t kDepth = 6;

    static void SetUpTestSuite() {
        scratch_ = std::make_unique<testing::ScratchFolder>();
        const auto database = testing::make_pattern_database({}, scratch_->path() / "db");
        pager_ = std::move(Pager::create(database, {.threads = 1, .mesh = MeshKind::Nested}).value());
        for (std::uint32_t depth = 1; depth <= kDepth; ++depth) {
            const TileId middle = tile_at(kLatitudeDeg, kLongitudeDeg, depth);
            std::vector<TileId> tiles{middle};
            for (const Edge edge : kEdges) {
                if (const auto beside = neighbour(middle, edge)) tiles.push_back(*beside);
            }
            load(tiles);
        }
    }
    static void TearDownTestSuite() {
        pager_.reset();
        scratch_.reset();
    }
    static void load(const std::vector<TileId>& tiles) {
        std::vector<BlockRequest> wishes;
        std::set<TileId> parents;
        for (const TileId tile : tiles) {
            if (!parents.insert(parent(tile)).second) continue;
            TileNode* above = pager_->tree().find(parent(tile));
            ASSERT_NE(above, nullptr);
            for (TileNode& child : pager_->tree().children(*above)) wishes.push_back({&child, 1.0});
        }
        pager_->request(wishes);
        pager_->wait_for_loads();
        pager_->publish(100, 1);
    }
    static const TileNode& node(std::uint32_t depth) {
        return *pager_->tree().find(tile_at(kLatitudeDeg, kLongitudeDeg, depth));
    }
    static MotionView from(double above_m, double north_m = 0.0, bool morph = true) {
        const Ecef eye =
            to_ecef({kLatitudeDeg + north_m / 111000.0, kLongitudeDeg, EllipsoidalHeight{above_m}});
        return motion_view({.eye = eye, .kappa_px = 600.0, .tau_px = 1.0}, morph);
    }

    static std::unique_ptr<testing::ScratchFolder> scratch_;
    static std::unique_ptr<Pager> pager_;
};
std::unique_ptr<testing::ScratchFolder> NestedMotionTest::scratch_;
std::unique_ptr<Pager> NestedMotionTest::pager_;

TEST_F(NestedMotionTest, AVertexThatStaysHasTheSameBitsFromTheParent) {
    int compared = 0;
    for (std::uint32_t depth = 1; depth <= kDepth; ++depth) {
        const TileNode& child = node(depth);
        for (const double above_m : {2e3, 2e4, 2e5, 2e6, 2e7}) {
            for (std::uint16_t i = 0; i < kBlockVertices; ++i) {
                const BlockVertex& vertex = child.block->vertices[i];
                if (vertex.gone_level() != NestedMesh::kStays) continue;
                ++compared;
                const auto above = drawn_vertex(*child.parent, vertex.next(), {}, from(above_m));
                const auto below = drawn_vertex(child, i, {}, from(above_m));
                ASSERT_EQ(bits_of(below), bits_of(above)) << "depth " << depth << ", vertex " << i;
            }
        }
    }
    EXPECT_EQ(compared, 17 * 17 * 5 * static_cast<int>(kDepth));
}

TEST_F(NestedMotionTest, AVertexOnASharedEdgeHasTheSameBitsFromBothTiles) {
    for (std::uint32_t depth = 1; depth <= kDepth; ++depth) {
        const TileNode& west = node(depth);
        const TileNode& east = *pager_->tree().find(neighbour(west.tile, Edge::East).value());
        for (const double above_m : {2e3, 2e4, 2e5, 2e6, 2e7}) {
            for (int row = 0; row < kBlockPosts; ++row) {
                const auto on_west = static_cast<std::uint16_t>(row * kBlockPosts + kBlockCells);
                const auto on_east = static_cast<std::uint16_t>(row * kBlockPosts);
                ASSERT_EQ(bits_of(drawn_vertex(west, on_west, {}, from(above_m))),
                          bits_of(drawn_vertex(east, on_east, {}, from(above_m))))
                    << "depth " << depth << ", row " << row;
            }
        }
    }
}

TEST_F(NestedMotionTest, AVertexThatHasGoneCoincidesWithItsTarget) {
    int coinciding = 0, apart = 0;
    for (std::uint32_t depth = 0; depth <= kDepth; ++depth) {
        const TileNode& tile = node(depth);
        for (const double above_m : {2e3, 2e4, 2e5, 2e6, 2e7}) {
            const MotionView view = from(above_m);
            for (std::uint16_t i = 0; i < kBlockVertices; ++i) {
                const BlockVertex& vertex = tile.block->vertices[i];
                if (vertex.gone_level() == NestedMesh::kStays) continue;
                const Ecef at = glm::dvec3{vertex.high[0], vertex.high[1], vertex.high[2]} +
                                glm::dvec3{vertex.low[0], vertex.low[1], vertex.low[2]};
                const Ecef eye = glm::dvec3{view.eye.high[0], view.eye.high[1], view.eye.high[2]} +
                                 glm::dvec3{view.eye.low[0], view.eye.low[1], view.eye.low[2]};
                const double level = level_at(glm::distance(at, eye), level_scale(1.0, 600.0));
                const auto drawn = drawn_vertex(tile, i, {}, view);
                const auto target = drawn_vertex(tile, vertex.next(), {}, view);
                if (level >= vertex.gone_level() + kLevelMargin) {
                    ++coinciding;
                    ASSERT_EQ(bits_of(drawn), bits_of(target));
                } else if (level < vertex.gone_level() - 1.0) {
                    ++apart;
                    ASSERT_LT(glm::distance(glm::dvec3{drawn.from_eye}, at - eye),
                              1e-6 * glm::distance(at, eye) + 1e-6);
                }
            }
        }
    }
    EXPECT_GT(coinciding, 1000);
    EXPECT_GT(apart, 1000);
}

TEST_F(NestedMotionTest, ASmallStepOfTheEyeMovesEveryVertexALittle) {
    // While the eye comes nearer by dD, lambda changes by 2/ln 2 dD/D levels: a vertex slides by that share
    // of the way to its target, and so do its target and that one's target at the same time.
    constexpr double kStepM = 1.0, kTargetsM = 1.0e6;
    const TileNode& tile = node(3);
    for (double above_m = 3e5; above_m < 3e7; above_m *= 1.07) {
        const MotionView here = from(above_m), there = from(above_m + kStepM);
        const glm::dvec3 moved = glm::dvec3{there.eye.high[0], there.eye.high[1], there.eye.high[2]} +
                                 glm::dvec3{there.eye.low[0], there.eye.low[1], there.eye.low[2]} -
                                 glm::dvec3{here.eye.high[0], here.eye.high[1], here.eye.high[2]} -
                                 glm::dvec3{here.eye.low[0], here.eye.low[1], here.eye.low[2]};
        for (std::uint16_t i = 0; i < kBlockVertices; i += 7) {
            const auto a = drawn_vertex(tile, i, {}, here), b = drawn_vertex(tile, i, {}, there);
            const double slid_m = glm::length(glm::dvec3{b.from_eye} + moved - glm::dvec3{a.from_eye});
            const double rounding_m = 4e-7 * glm::length(glm::dvec3{a.from_eye});
            ASSERT_LT(slid_m, 3.0 * 2.9 * kStepM / above_m * kTargetsM + 100.0 * rounding_m) << above_m;
        }
    }
}

TEST_F(NestedMotionTest, AFloorShutsWhatABlockAtThatLevelLacks) {
    const TileNode& tile = node(3);
    MotionView near = from(2e3);
    near.level_scale_squared *= 1e-6F;  // a tolerance so small that nothing has set out
    EdgeFloors floors{};
    floors[0] = tile.info.last_level;  // southern half of the western edge
    for (int row = 1; row < kBlockCells / 2; row += 2) {
        const auto odd = static_cast<std::uint16_t>(row * kBlockPosts);
        const auto even = static_cast<std::uint16_t>((row - 1) * kBlockPosts);
        EXPECT_NE(bits_of(drawn_vertex(tile, odd, {}, near)), bits_of(drawn_vertex(tile, even, {}, near)));
        EXPECT_EQ(bits_of(drawn_vertex(tile, odd, floors, near)),
                  bits_of(drawn_vertex(tile, even, floors, near)));
        const auto north = static_cast<std::uint16_t>((row + kBlockCells / 2) * kBlockPosts);
        EXPECT_EQ(bits_of(drawn_vertex(tile, north, floors, near)),
                  bits_of(drawn_vertex(tile, north, {}, near)));
    }
}

TEST_F(NestedMotionTest, WithoutMorphAVertexIsInItsPlaceOrItsTargets) {
    const TileNode& tile = node(3);
    for (const double above_m : {1e6, 2e6, 4e6, 8e6}) {
        const MotionView jump = from(above_m, 0.0, false);
        for (std::uint16_t i = 0; i < kBlockVertices; ++i) {
            const glm::vec2 units = drawn_vertex(tile, i, {}, jump).place * float{kBlockCells};
            EXPECT_EQ(units, glm::floor(units)) << "vertex " << i << " is between posts";
        }
    }
}

}  // namespace
}  // namespace eyepoint::terrain
