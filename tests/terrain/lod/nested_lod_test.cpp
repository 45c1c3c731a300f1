#include <algorithm>
#include <bit>
#include <cmath>
#include <random>
#include <string>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "terrain/geodesy/earth.hpp"
#include "terrain/lod/nested.hpp"
#include "terrain/lod/nested_motion.hpp"
#include "tests/support/analytic_terrain.hpp"
#include "tests/terrain/lod/look.hpp"
#include "tests/terrain/lod/method_flight.hpp"
#include "tests/terrain/lod/nested_mesh.hpp"
#include "tests/terrain/lod/pattern_planet.hpp"
#include "tools/bench/allocation_count.hpp"

namespace eyepoint::terrain {
namespace {

using testing::count_stacked;
using testing::drawn_triangles;
using testing::find_nested_faults;
using testing::look;
using testing::NestedFaults;

struct Stand {
    double latitude_deg = 46.5;
    double longitude_deg = 8.25;
    double above_m = 3000.0;
    double course_rad = 0.3;
    double down_rad = 0.3;
};
LodView look_from(const Stand& stand, double tau_px, double slack_px = 0.0) {
    const glm::dmat3 enu = east_north_up(stand.latitude_deg, stand.longitude_deg);
    const glm::dvec3 forward =
        enu * glm::dvec3{std::sin(stand.course_rad) * std::cos(stand.down_rad),
                         std::cos(stand.course_rad) * std::cos(stand.down_rad), -std::sin(stand.down_rad)};
    const Ecef eye = to_ecef({stand.latitude_deg, stand.longitude_deg, EllipsoidalHeight{stand.above_m}});
    return look(eye, forward, enu * glm::dvec3{0.1, 0.05, 1.0}, tau_px, slack_px);
}

class NestedLodTest : public ::testing::Test {
  protected:
    static void SetUpTestSuite() {
        scratch_ = std::make_unique<testing::ScratchFolder>();
        database_ = testing::make_pattern_database({}, scratch_->path() / "db");
    }
    static void TearDownTestSuite() {
        database_.reset();
        scratch_.reset();
    }
    static std::unique_ptr<Pager> open(std::uint64_t cache_bytes = 1ULL << 32) {
        return std::move(
            Pager::create(database_, {.threads = 2, .mesh = MeshKind::Nested, .cache_bytes = cache_bytes})
                .value());
    }

    static std::unique_ptr<testing::ScratchFolder> scratch_;
    static std::shared_ptr<const Database> database_;
};
std::unique_ptr<testing::ScratchFolder> NestedLodTest::scratch_;
std::shared_ptr<const Database> NestedLodTest::database_;

using NestedFlight = testing::MethodFlight<NestedLod>;

/// With whole blocks, or cut into cells.
NestedFlight fly(std::unique_ptr<Pager> pager, bool reuse, bool cut = false) {
    return NestedFlight{std::move(pager), reuse, false, cut};
}

void expect_whole(const Selection& selection, const LodView& view, const std::string& where) {
    const NestedFaults faults = find_nested_faults(selection.draws, motion_view(view));
    EXPECT_EQ(faults.cracks, 0U) << where;
    EXPECT_EQ(count_stacked(selection.draws), 0U) << where;
}

Stand random_stand(std::mt19937_64& random, const Stand& middle) {
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    Stand stand;
    stand.latitude_deg = std::clamp(middle.latitude_deg + 2.0 * unit(random) - 1.0, -90.0, 90.0);
    stand.longitude_deg = middle.longitude_deg + 2.0 * unit(random) - 1.0;
    // Lower over a pole, an eye is in the boxes of all tiles that meet there: thousands of blocks.
    stand.above_m = std::pow(10.0, (std::abs(middle.latitude_deg) > 80.0 ? 3.3 : 2.5) + 3.5 * unit(random));
    stand.course_rad = 6.283 * unit(random);
    stand.down_rad = 1.5 * unit(random) * unit(random);
    return stand;
}

TEST_F(NestedLodTest, DrawnMeshHasNoCracksFromRandomEyes) {
    NestedFlight flight = fly(open(), true);
    std::mt19937_64 random(20261122);
    const std::array<Stand, 4> places{Stand{46.5, 8.25}, Stand{0.0, 0.0}, Stand{-16.8, 180.0},
                                      Stand{89.7, 30.0}};
    for (int i = 0; i < 24; ++i) {
        const Stand stand = random_stand(random, places[static_cast<std::size_t>(i) % places.size()]);
        const LodView view = look_from(stand, 0.5 + i % 4, 0.1 * (i % 3));
        expect_whole(flight.settle(view), view, "eye " + std::to_string(i));
    }
}

TEST_F(NestedLodTest, HasNoCracksWhileBlocksAreStillArriving) {
    NestedFlight flight = fly(open(), true);
    std::mt19937_64 random(7);
    for (int i = 0; i < 6; ++i) {
        const LodView view = look_from(random_stand(random, {46.5, 8.25}), 1.0);
        for (int frame = 0; frame < 60; ++frame) {
            const Selection& selection = flight.step(view);
            expect_whole(selection, view, "eye " + std::to_string(i) + ", frame " + std::to_string(frame));
            if (selection.wishes.empty()) break;
            flight.receive(7);
        }
    }
}

TEST_F(NestedLodTest, EveryVertexIsAskedForAtLeastTheLevelOfItsList) {
    NestedFlight flight = fly(open(), true);
    std::mt19937_64 random(3);
    for (int i = 0; i < 8; ++i) {
        const LodView view = look_from(random_stand(random, {46.5, 8.25}), 1.0, 0.1);
        const double scale = level_scale(view.tau_px + view.slack_px, view.kappa_px);
        for (const BlockDraw& draw : flight.settle(view).draws) {
            for (const BlockVertex& vertex : draw.node->block->vertices) {
                const Ecef at = glm::dvec3{vertex.high[0], vertex.high[1], vertex.high[2]} +
                                glm::dvec3{vertex.low[0], vertex.low[1], vertex.low[2]};
                if (draw.level > 0) {
                    ASSERT_GE(level_at(glm::distance(at, view.eye), scale), draw.level);
                }
            }
        }
    }
}

/// Drawn triangles that are wholly in view, on this side of the horizon of a bare Earth: where tiles of
/// different sizes are culled alike.
std::vector<testing::DrawnTriangle> seen_triangles(const Selection& selection, const LodView& view) {
    auto triangles = drawn_triangles(selection.draws, motion_view(view));
    const double radius_m = kPolarRadiusM - 1000.0, eye_m = glm::length(view.eye);
    const double horizon_m = std::sqrt(eye_m * eye_m - radius_m * radius_m);
    const auto unseen = [&](const testing::PointBits& bits) {
        const glm::dvec3 at{std::bit_cast<float>(bits[0]), std::bit_cast<float>(bits[1]),
                            std::bit_cast<float>(bits[2])};
        return glm::length(at) > horizon_m ||
               std::any_of(view.sides.begin(), view.sides.end(),
                           [&](const auto& side) { return glm::dot(side, at) < 0.0; });
    };
    std::erase_if(triangles, [&](const testing::DrawnTriangle& triangle) {
        return std::any_of(triangle.corners.begin(), triangle.corners.end(), unseen);
    });
    return triangles;
}

TEST_F(NestedLodTest, ReusedChoicesDrawTheSameSurface) {
    NestedFlight cached = fly(open(), true), fresh = fly(open(), false);
    std::mt19937_64 random(11);
    std::uint64_t reused = 0, chosen = 0, seen = 0;
    for (int walk = 0; walk < 6; ++walk) {
        Stand stand = random_stand(random, {46.5, 8.25});
        cached.settle(look_from(stand, 1.0));
        for (int i = 0; i < 12; ++i) {
            stand.latitude_deg += stand.above_m * 2e-8;
            stand.course_rad += 0.002;
            stand.above_m *= 0.998;
            const double tau_px = 1.0 + 0.02 * std::sin(0.7 * i);
            const LodView view = look_from(stand, tau_px, 0.1 * tau_px);
            const Selection& selection = cached.settle(view);
            reused += selection.blocks_reused;
            chosen += selection.blocks_chosen;
            const auto triangles = seen_triangles(selection, view);
            seen += triangles.size();
            ASSERT_TRUE(triangles == seen_triangles(fresh.settle(view), view))
                << "walk " << walk << ", step " << i;
        }
    }
    EXPECT_GT(reused, 4 * chosen);
    EXPECT_GT(seen, 5000U);
}

TEST_F(NestedLodTest, AChoiceStandsThroughJumpsAndChangesOfTolerance) {
    NestedFlight cached = fly(open(), true), fresh = fly(open(), false);
    std::mt19937_64 random(17);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (int i = 0; i < 40; ++i) {
        const double tau_px = std::exp2(4.0 * unit(random) - 2.0);
        LodView view = look_from(random_stand(random, {46.5, 8.25}), tau_px, 0.2 * unit(random) * tau_px);
        view.kappa_px *= 0.5 + unit(random);
        ASSERT_TRUE(seen_triangles(cached.settle(view), view) == seen_triangles(fresh.settle(view), view))
            << i;
    }
}

/// Places on the ground in view, the horizon far: each is in exactly one drawn tile.
TEST_F(NestedLodTest, DrawnTilesCoverTheViewOnce) {
    NestedFlight flight = fly(open(), true);
    std::mt19937_64 random(23);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    int looked_at = 0;
    for (int i = 0; i < 10; ++i) {
        const Stand stand = random_stand(random, {46.5, 8.25});
        const LodView view = look_from(stand, 1.0);
        const Selection& selection = flight.settle(view);
        EXPECT_EQ(count_stacked(selection.draws), 0U);
        for (int place = 0; place < 1000; ++place) {
            const double reach_deg = stand.above_m * 3e-5;
            const double latitude_deg = stand.latitude_deg + reach_deg * unit(random);
            const double longitude_deg = stand.longitude_deg + reach_deg * unit(random);
            const Ecef at = to_ecef({latitude_deg, longitude_deg, EllipsoidalHeight{0.0}});
            const auto beyond = [&](const glm::dvec3& side) { return glm::dot(side, at - view.eye) < 0.0; };
            const bool near =
                glm::distance(at, view.eye) < 3.0 * stand.above_m && std::abs(latitude_deg) < 89.0;
            if (!near || std::any_of(view.sides.begin(), view.sides.end(), beyond)) continue;
            ++looked_at;
            EXPECT_EQ(std::count_if(selection.draws.begin(), selection.draws.end(),
                                    [&](const BlockDraw& draw) {
                                        const TileId tile = draw.node->tile;
                                        return tile_at(latitude_deg, longitude_deg, tile.depth) == tile;
                                    }),
                      1);
        }
    }
    EXPECT_GT(looked_at, 500);
}

TEST_F(NestedLodTest, DrawsComeNearToFar) {
    NestedFlight flight = fly(open(), true);
    const LodView view = look_from({.above_m = 5000.0}, 0.02);
    const Selection& selection = flight.settle(view);
    ASSERT_GE(selection.draws.size(), 20U);
    // A quadtree's order: no tile hides one drawn before it, which for tiles of one size means nearer middles
    // first.
    for (std::size_t i = 1; i < selection.draws.size(); ++i) {
        const TileNode &before = *selection.draws[i - 1].node, &after = *selection.draws[i].node;
        if (before.parent != after.parent) continue;
        EXPECT_LE(glm::distance(before.bounds.centre, view.eye),
                  glm::distance(after.bounds.centre, view.eye));
    }
}

TEST_F(NestedLodTest, ASteadyViewAllocatesNothingAndMakesNoChoice) {
    NestedFlight flight = fly(open(), true, true);
    Stand stand{.above_m = 2000.0};
    flight.settle(look_from(stand, 0.25, 0.025));
    for (int i = 0; i < 100; ++i) {
        stand.latitude_deg += 1e-9;
        const LodView view = look_from(stand, 0.25, 0.025);
        const std::uint64_t before = tools::heap_allocations();
        const Selection& selection = flight.select(view);
        ASSERT_EQ(tools::heap_allocations(), before);
        ASSERT_TRUE(selection.wishes.empty());
        ASSERT_EQ(selection.blocks_chosen, 0U);
        ASSERT_GT(selection.blocks_reused, 10U);
    }
}

TEST_F(NestedLodTest, AnEvictedTileIsNoticedAndStaysWholeUntilItIsBack) {
    NestedFlight flight = fly(open(1), true);
    const LodView near = look_from({.above_m = 1000.0}, 0.5), away = look_from({-30.0, -120.0, 1000.0}, 0.5);
    const auto before = seen_triangles(flight.settle(near), near);
    flight.settle(away);
    flight.skip(1000);
    flight.select(away);
    flight.pager().publish(0, flight.frame());
    ASSERT_GT(flight.pager().counters().evicted, 0U);
    const Selection& selection = flight.select(near);
    EXPECT_FALSE(selection.wishes.empty());
    expect_whole(selection, near, "after the eviction");
    EXPECT_TRUE(seen_triangles(flight.settle(near), near) == before);
}

}  // namespace
}  // namespace eyepoint::terrain
