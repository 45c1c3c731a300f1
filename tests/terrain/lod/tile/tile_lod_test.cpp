#include "terrain/lod/tile/tile_lod.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "terrain/geodesy/earth.hpp"
#include "tests/terrain/lod/look.hpp"
#include "tests/terrain/lod/method_flight.hpp"
#include "tests/terrain/lod/places.hpp"
#include "tests/terrain/lod/selection_checks.hpp"

namespace eyepoint::terrain {
namespace {

using testing::expect_whole;
using testing::hills;
using testing::look;
using testing::sea;

using TileFlight = testing::MethodFlight<TileLod>;

testing::MeshFaults faults_of(const TileFlight& flight, std::span<const BlockDraw> draws) {
    return testing::find_faults(draws, flight.method().indices());
}

class TileLodAt : public ::testing::TestWithParam<testing::Place> {};

TEST_P(TileLodAt, DrawnMeshHasNoCracksFromRandomEyes) {
    const testing::AnalyticPlanet& planet = GetParam().planet();
    TileFlight flight(planet.database());
    std::mt19937_64 random(20261122);
    for (int i = 0; i < 16; ++i) {
        const Selection& selection = flight.settle(testing::random_view(planet.terrain(), random));
        expect_whole(faults_of(flight, selection.draws), "eye " + std::to_string(i));
    }
}

INSTANTIATE_TEST_SUITE_P(Earth, TileLodAt, ::testing::ValuesIn(testing::places()), testing::place_name);

TEST(TileLod, HasNoCracksWhileBlocksAreStillArriving) {
    TileFlight flight(hills().database());
    const Ecef eye = to_ecef({46.5, 8.25, EllipsoidalHeight{2500.0}});
    const glm::dmat3 enu = east_north_up(46.5, 8.25);
    const LodView view = look(eye, enu * glm::dvec3{0.3, 1.0, -0.2}, enu[2], 1.0);
    std::uint64_t triangles = 0;
    for (int frame = 0; frame < 400; ++frame) {
        const Selection& selection = flight.step(view);
        expect_whole(faults_of(flight, selection.draws), "frame " + std::to_string(frame));
        triangles = std::max(triangles, selection.triangles);
        if (selection.wishes.empty()) break;
        flight.receive(3);
    }
    EXPECT_GT(triangles, 2000U);
}

TEST(TileLod, ABlockDrawnCoarserThanItsNeighboursKnowIsCountedAsCracks) {
    TileFlight flight(hills().database());
    const Ecef eye = to_ecef({46.5, 8.25, EllipsoidalHeight{2500.0}});
    const glm::dmat3 enu = east_north_up(46.5, 8.25);
    const Selection& selection = flight.settle(look(eye, enu * glm::dvec3{0.3, 1.0, -0.2}, enu[2], 1.0));
    std::vector<BlockDraw> draws = selection.draws;
    ASSERT_GT(draws.size(), 4U);
    const int level = draws[1].level;
    const tiles::Division division = tiles::division(33);
    ASSERT_LT(level, division.levels - 1);
    draws[1].indices = tiles::TileMeshes{division}.range(0, level + 1, 0);
    EXPECT_GT(faults_of(flight, draws).cracks, 0U);
}

TEST(TileLod, ASmallerToleranceDrawsMore) {
    TileFlight flight(hills().database());
    const Ecef eye = to_ecef({46.5, 8.25, EllipsoidalHeight{3000.0}});
    const glm::dmat3 enu = east_north_up(46.5, 8.25);
    std::uint64_t before = 0;
    for (const double tau_px : {8.0, 2.0, 0.5}) {
        const std::uint64_t triangles =
            flight.settle(look(eye, enu * glm::dvec3{0.0, 1.0, -0.7}, enu[2], tau_px)).triangles;
        EXPECT_GT(triangles, before) << "tau " << tau_px;
        before = triangles;
    }
}

TEST(TileLod, EveryDrawnBlockIsFineEnoughOnceLoaded) {
    TileFlight flight(hills().database());
    const Ecef eye = to_ecef({46.5, 8.25, EllipsoidalHeight{3000.0}});
    const glm::dmat3 enu = east_north_up(46.5, 8.25);
    const LodView view = look(eye, enu * glm::dvec3{0.0, 1.0, -0.15}, enu[2], 1.0);
    for (const BlockDraw& draw : flight.settle(view).draws) {
        const TileNode& node = *draw.node;
        const double error_m = node.info.delta_m[draw.level];
        const double distance = std::max(distance_m(node.bounds, eye), view.near_m);
        EXPECT_LE(view.kappa_px * error_m / distance, view.tau_px * (1.0 + 1e-9));
    }
}

TEST(TileLod, FromSpaceTheWholeVisibleHemisphereIsDrawn) {
    TileFlight flight(sea().database());
    const Ecef eye{3.0e7, 0.0, 0.0};
    const Selection& selection = flight.settle(look(eye, {-1.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, 1.0));
    expect_whole(faults_of(flight, selection.draws), "space");
    EXPECT_EQ(selection.draws.size(), 2U) << "both roots, the far side hidden inside them";
}

/// Whether the segment between two points passes through WGS84 made smaller by so many metres: closed form,
/// in the space where it is the unit sphere.
bool ellipsoid_between(const Ecef& a, const Ecef& b, double lower_m) {
    const glm::dvec3 radii{kEquatorialRadiusM - lower_m, kEquatorialRadiusM - lower_m,
                           kPolarRadiusM - lower_m};
    const glm::dvec3 from = a / radii, step = (b - a) / radii;
    const double aa = glm::dot(step, step), bb = glm::dot(from, step), cc = glm::dot(from, from) - 1.0;
    const double root = bb * bb - aa * cc;
    if (root <= 0.0) return false;
    const double first = (-bb - std::sqrt(root)) / aa;
    return first > 0.0 && first < 1.0;
}

bool any_part_drawn(const Selection& selection, TileId tile) {
    return std::any_of(selection.draws.begin(), selection.draws.end(), [&](const BlockDraw& draw) {
        const TileId drawn = draw.node->tile;
        return drawn.depth <= tile.depth ? ancestor(tile, drawn.depth) == drawn
                                         : ancestor(drawn, tile.depth) == tile;
    });
}

TEST(TileLod, WhereDrawingEndsAtTheHorizonTheDrawnMeshItselfHidesTheEnd) {
    TileFlight flight(sea().database());
    for (const double height_m : {50.0, 3000.0, 12000.0}) {
        const Ecef eye = to_ecef({10.0, 50.0, EllipsoidalHeight{height_m}});
        const glm::dmat3 enu = east_north_up(10.0, 50.0);
        const LodView view = look(eye, enu[1], enu[2], 2.0);
        const Selection& selection = flight.settle(view);
        // The sea's mesh may be drawn tau pixels too low at its horizon, and no lower.
        const double horizon_m = std::sqrt(2.0 * kEquatorialRadiusM * height_m);
        const double drawn_lower_m = view.tau_px / view.kappa_px * horizon_m;
        int ends = 0;
        for (const BlockDraw& draw : selection.draws) {
            const auto beside = neighbour(draw.node->tile, Edge::North);
            if (!beside || any_part_drawn(selection, *beside)) continue;
            for (int column = 0; column < kBlockPosts; ++column) {
                const TileId tile = draw.node->tile;
                const Ecef post =
                    to_ecef({post_latitude_deg(tile, kBlockCells), post_longitude_deg(tile, column), {}});
                const auto beyond = [&](const glm::dvec3& side) { return glm::dot(side, post - eye) < 0.0; };
                if (std::any_of(view.sides.begin(), view.sides.end(), beyond)) continue;
                ++ends;
                EXPECT_TRUE(ellipsoid_between(eye, post, drawn_lower_m)) << "from " << height_m << " m";
            }
        }
        EXPECT_GT(ends, 0) << "from " << height_m << " m";
    }
}

}  // namespace
}  // namespace eyepoint::terrain
