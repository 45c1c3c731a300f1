#include "terrain/lod/tile/tile_lod.hpp"

#include <cmath>
#include <random>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "terrain/geodesy/earth.hpp"
#include "terrain/pager/pager.hpp"
#include "tests/support/analytic_terrain.hpp"
#include "tests/terrain/lod/drawn_mesh.hpp"
#include "tests/terrain/lod/look.hpp"

namespace eyepoint::terrain {
namespace {

using testing::AnalyticTerrain;
using testing::find_faults;
using testing::look;
using testing::MeshFaults;
using testing::ScratchFolder;

/// Everything the view asks for, loaded; then the selection.
class Flight {
  public:
    explicit Flight(const AnalyticTerrain& terrain)
        : database_(testing::make_database(terrain, scratch_.path() / "db")),
          pager_(std::move(Pager::create(database_, {.threads = 1, .cache_bytes = 1ULL << 30}).value())) {}

    const Selection& settle(const LodView& view) {
        while (true) {
            pager_->publish(100000, frame_);
            const Selection& selection = step(view);
            if (!pager_->wait_for_loads()) return selection;
        }
    }
    const Selection& step(const LodView& view) {
        const Selection& selection = lod_.select(view, pager_->tree(), ++frame_);
        pager_->request(selection.wishes);
        return selection;
    }
    std::size_t publish(std::size_t most) { return pager_->publish(most, frame_); }
    bool wait() { return pager_->wait_for_loads(); }
    MeshFaults faults(std::span<const BlockDraw> draws) const { return find_faults(draws, lod_.indices()); }

  private:
    ScratchFolder scratch_;
    std::shared_ptr<const Database> database_;
    std::unique_ptr<Pager> pager_;
    TileLod lod_;
    std::uint64_t frame_ = 0;
};

void expect_whole(const MeshFaults& faults, const std::string& where) {
    EXPECT_GT(faults.edges, 0U) << where;
    EXPECT_EQ(faults.cracks, 0U) << where;
    EXPECT_EQ(faults.overlaps, 0U) << where;
    EXPECT_EQ(faults.unequal_bits, 0U) << where;
    EXPECT_EQ(faults.folded, 0U) << where;
}

struct Place {
    const char* name;
    AnalyticTerrain terrain;
};
void PrintTo(const Place& place, std::ostream* stream) { *stream << place.name; }

/// Over the pole itself, an eye among the hills is in the bounding boxes of all tiles that meet there,
/// 2^(d+1) at depth d: thousands of blocks at full resolution. Above the highest hill a few hundred show the
/// same seams.
double clearance_m(double latitude_deg) { return latitude_deg == 90.0 ? 2000.0 : 0.0; }

class TileLodAt : public ::testing::TestWithParam<Place> {};

TEST_P(TileLodAt, DrawnMeshHasNoCracksFromRandomEyes) {
    const AnalyticTerrain terrain = GetParam().terrain;
    Flight flight(terrain);
    std::mt19937_64 random(20261122);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (int i = 0; i < 16; ++i) {
        const double latitude_deg =
            std::min(90.0, terrain.latitude_deg + (unit(random) * 2.0 - 1.0) * 1.2 * terrain.half_size_deg);
        const double longitude_deg =
            terrain.longitude_deg + (unit(random) * 2.0 - 1.0) * 1.2 * terrain.half_size_deg;
        const double above_m = std::max(std::pow(10.0, 0.3 + 5.5 * unit(random)), clearance_m(latitude_deg));
        const double ground_m = testing::analytic_height_m(terrain, latitude_deg, longitude_deg);
        const Ecef eye = to_ecef({latitude_deg, longitude_deg, EllipsoidalHeight{ground_m + above_m}});
        const glm::dmat3 enu = east_north_up(std::min(latitude_deg, 90.0), longitude_deg);
        const double course = unit(random) * 6.283, down = -1.5 * unit(random) * unit(random);
        const glm::dvec3 forward = enu * glm::dvec3{std::sin(course) * std::cos(down),
                                                    std::cos(course) * std::cos(down), std::sin(down)};
        const LodView view = look(eye, forward, enu * glm::dvec3{0.1, 0.05, 1.0}, 0.5 + 4.0 * unit(random));
        const Selection& selection = flight.settle(view);
        expect_whole(flight.faults(selection.draws),
                     std::string(GetParam().name) + ", eye " + std::to_string(i));
    }
}

INSTANTIATE_TEST_SUITE_P(
    Earth, TileLodAt,
    ::testing::Values(Place{"alps", {}}, Place{"equator", {.latitude_deg = 0.0, .longitude_deg = 0.0}},
                      Place{"antimeridian", {.latitude_deg = -16.8, .longitude_deg = 180.0}},
                      Place{"pole", {.latitude_deg = 89.7, .longitude_deg = 30.0, .detail_depth = 8}}),
    [](const auto& place) { return std::string(place.param.name); });

TEST(TileLod, HasNoCracksWhileBlocksAreStillArriving) {
    Flight flight({});
    const Ecef eye = to_ecef({46.5, 8.25, EllipsoidalHeight{2500.0}});
    const glm::dmat3 enu = east_north_up(46.5, 8.25);
    const LodView view = look(eye, enu * glm::dvec3{0.3, 1.0, -0.2}, enu[2], 1.0);
    std::uint64_t triangles = 0;
    for (int frame = 0; frame < 400; ++frame) {
        const Selection& selection = flight.step(view);
        expect_whole(flight.faults(selection.draws), "frame " + std::to_string(frame));
        triangles = std::max(triangles, selection.triangles);
        if (selection.wishes.empty()) break;
        flight.wait();
        flight.publish(3);
    }
    EXPECT_GT(triangles, 2000U);
}

TEST(TileLod, ABlockDrawnCoarserThanItsNeighboursKnowIsCountedAsCracks) {
    Flight flight({});
    const Ecef eye = to_ecef({46.5, 8.25, EllipsoidalHeight{2500.0}});
    const glm::dmat3 enu = east_north_up(46.5, 8.25);
    const Selection& selection = flight.settle(look(eye, enu * glm::dvec3{0.3, 1.0, -0.2}, enu[2], 1.0));
    std::vector<BlockDraw> draws = selection.draws;
    ASSERT_GT(draws.size(), 4U);
    const int level = draws[1].level;
    const tiles::Division division = tiles::division(33);
    ASSERT_LT(level, division.levels - 1);
    draws[1].indices = tiles::TileMeshes{division}.range(0, level + 1, 0);
    EXPECT_GT(flight.faults(draws).cracks, 0U);
}

TEST(TileLod, ASmallerToleranceDrawsMore) {
    Flight flight({});
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
    Flight flight({});
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
    Flight flight({.amplitude_m = 0.0});
    const Ecef eye{3.0e7, 0.0, 0.0};
    const Selection& selection = flight.settle(look(eye, {-1.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, 1.0));
    expect_whole(flight.faults(selection.draws), "space");
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
    Flight flight({.amplitude_m = 0.0});
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
