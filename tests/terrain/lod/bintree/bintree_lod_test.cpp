#include "terrain/lod/bintree/bintree_lod.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "terrain/geodesy/earth.hpp"
#include "terrain/pager/pager.hpp"
#include "tests/support/analytic_terrain.hpp"
#include "tests/terrain/lod/drawn_mesh.hpp"
#include "tests/terrain/lod/look.hpp"
#include "tools/bench/allocation_count.hpp"

namespace eyepoint::terrain {
namespace {

using testing::AnalyticTerrain;
using testing::look;
using testing::MeshFaults;

/// A pager and the method over one planet.
class Flight {
  public:
    explicit Flight(std::shared_ptr<const Database> database, std::uint32_t triangle_budget = 0)
        : pager_(std::move(
              Pager::create(std::move(database), {.threads = 1, .cache_bytes = 1ULL << 30}).value())),
          lod_(triangle_budget) {}

    const Selection& step(const LodView& view) {
        const Selection& selection = lod_.select(view, pager_->tree(), ++frame_);
        pager_->request(selection.wishes);
        return selection;
    }
    /// Everything the view asks for, loaded; then the selection.
    const Selection& settle(const LodView& view) {
        while (true) {
            pager_->publish(100000, frame_);
            const Selection& selection = step(view);
            if (!pager_->wait_for_loads()) return selection;
        }
    }
    void publish(std::size_t most) {
        (void)pager_->wait_for_loads();
        pager_->publish(most, frame_);
    }

  private:
    std::unique_ptr<Pager> pager_;
    BintreeLod lod_;
    std::uint64_t frame_ = 0;
};

/// One planet for all tests of a place.
struct Planet {
    testing::ScratchFolder scratch;
    AnalyticTerrain terrain;
    std::shared_ptr<const Database> database;
    explicit Planet(const AnalyticTerrain& shape)
        : terrain(shape), database(testing::make_database(shape, scratch.path() / "db")) {}
};
const Planet& alps() {
    static const Planet planet{{}};
    return planet;
}

/// Metres above the hills' mean level, towards a course, degrees down.
LodView look_from(double above_m, double course_deg, double down_deg, double tau_px) {
    const glm::dmat3 enu = east_north_up(46.5, 8.25);
    const double course = course_deg * 3.14159265358979 / 180.0, down = down_deg * 3.14159265358979 / 180.0;
    const glm::dvec3 forward = enu * glm::dvec3{std::sin(course) * std::cos(down),
                                                std::cos(course) * std::cos(down), -std::sin(down)};
    const Ecef eye = to_ecef({46.5, 8.25, EllipsoidalHeight{above_m}});
    return look(eye, forward, enu * glm::dvec3{0.1, 0.05, 1.0}, tau_px);
}

void expect_whole(const Selection& selection, const std::string& where) {
    const MeshFaults faults = testing::find_faults(selection.draws, {});
    EXPECT_GT(faults.edges, 0U) << where;
    EXPECT_EQ(faults.cracks, 0U) << where;
    EXPECT_EQ(faults.overlaps, 0U) << where;
    EXPECT_EQ(faults.unequal_bits, 0U) << where;
    EXPECT_EQ(faults.folded, 0U) << where;
}

LodView random_view(const AnalyticTerrain& terrain, std::mt19937_64& random) {
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    const auto around = [&](double middle_deg) {
        return middle_deg + (unit(random) * 2.0 - 1.0) * 1.2 * terrain.half_size_deg;
    };
    const double latitude_deg = std::min(90.0, around(terrain.latitude_deg)),
                 longitude_deg = around(terrain.longitude_deg);
    // Over a pole itself an eye among the hills is in the boxes of all tiles that meet there, thousands.
    const double above_m =
        std::max(std::pow(10.0, 0.3 + 5.5 * unit(random)), latitude_deg == 90.0 ? 2000.0 : 0.0);
    const double ground_m = testing::analytic_height_m(terrain, latitude_deg, longitude_deg);
    const Ecef eye = to_ecef({latitude_deg, longitude_deg, EllipsoidalHeight{ground_m + above_m}});
    const glm::dmat3 enu = east_north_up(latitude_deg, longitude_deg);
    const double course = unit(random) * 6.283, down = -1.5 * unit(random) * unit(random);
    const glm::dvec3 forward = enu * glm::dvec3{std::sin(course) * std::cos(down),
                                                std::cos(course) * std::cos(down), std::sin(down)};
    return look(eye, forward, enu * glm::dvec3{0.1, 0.05, 1.0}, 0.5 + 4.0 * unit(random));
}

struct Place {
    const char* name;
    AnalyticTerrain terrain;
};
void PrintTo(const Place& place, std::ostream* stream) { *stream << place.name; }

class BintreeLodAt : public ::testing::TestWithParam<Place> {};

TEST_P(BintreeLodAt, DrawnMeshHasNoCracksFromRandomEyesNorWhileBlocksArrive) {
    const Planet planet{GetParam().terrain};
    Flight flight{planet.database};
    std::mt19937_64 random(20261122);
    for (int i = 0; i < 8; ++i) {
        const LodView view = random_view(planet.terrain, random);
        for (int frame = 0; frame < 4; ++frame) {
            expect_whole(flight.step(view), "arriving, eye " + std::to_string(i));
            flight.publish(5);
        }
        expect_whole(flight.settle(view), "loaded, eye " + std::to_string(i));
    }
}

INSTANTIATE_TEST_SUITE_P(
    Earth, BintreeLodAt,
    ::testing::Values(Place{"alps", {}}, Place{"equator", {.latitude_deg = 0.0, .longitude_deg = 0.0}},
                      Place{"antimeridian", {.latitude_deg = -16.8, .longitude_deg = 180.0}},
                      Place{"pole", {.latitude_deg = 89.7, .longitude_deg = 30.0, .detail_depth = 8}}),
    [](const auto& place) { return std::string(place.param.name); });

TEST(BintreeLod, ATurningEyeSeesNoCracksAsBlocksComeAndGo) {
    Flight flight{alps().database};
    (void)flight.settle(look_from(2500.0, 0.0, 10.0, 1.0));
    for (int frame = 0; frame < 60; ++frame) {
        const LodView view = look_from(2500.0 + 15.0 * frame, 7.0 * frame, 10.0, 1.0);
        expect_whole(flight.step(view), "frame " + std::to_string(frame));
        flight.publish(4);
    }
}

TEST(BintreeLod, ASmallerToleranceDrawsMore) {
    Flight flight{alps().database};
    std::uint64_t before = 0;
    for (const double tau_px : {8.0, 2.0, 0.5}) {
        const std::uint64_t triangles = flight.settle(look_from(3000.0, 0.0, 35.0, tau_px)).triangles;
        EXPECT_GT(triangles, before) << "tau " << tau_px;
        before = triangles;
    }
}

std::vector<std::vector<std::uint16_t>> lists(const Selection& selection) {
    std::vector<std::vector<std::uint16_t>> result;
    for (const BlockDraw& draw : selection.draws) result.push_back(draw.mesh->indices);
    return result;
}

TEST(BintreeLod, TheMeshDependsOnTheViewNotOnTheWayThere) {
    const LodView here = look_from(2500.0, 40.0, 12.0, 1.0);
    Flight direct{alps().database};
    const auto expected = lists(direct.settle(here));
    Flight round_about{alps().database};
    for (const LodView& view : {look_from(1500.0, 20.0, 5.0, 0.7), look_from(9000.0, 55.0, 60.0, 1.0),
                                look_from(2500.0, 220.0, 12.0, 4.0)})
        (void)round_about.settle(view);
    EXPECT_EQ(lists(round_about.settle(here)), expected);
}

TEST(BintreeLod, AStillEyeJudgesNothingAgainSendsNothingAndAllocatesNothing) {
    Flight flight{alps().database};
    const LodView view = look_from(2500.0, 40.0, 12.0, 1.0);
    (void)flight.settle(view);
    const auto versions = [](const Selection& selection) {
        std::vector<std::uint64_t> result;
        for (const BlockDraw& draw : selection.draws) result.push_back(draw.mesh->version);
        return result;
    };
    const auto before = versions(flight.step(view));
    const std::uint64_t allocated = tools::heap_allocations();
    const Selection& again = flight.step(view);
    EXPECT_EQ(tools::heap_allocations() - allocated, 0U);
    EXPECT_EQ(again.blocks_chosen, 0U);
    EXPECT_EQ(versions(again), before);
}

TEST(BintreeLod, AListThatChangesHasAnotherVersion) {
    Flight flight{alps().database};
    std::unordered_map<TileId, std::pair<std::uint64_t, std::vector<std::uint16_t>>, TileHash> seen;
    int changed = 0, kept = 0;
    for (int frame = 0; frame < 20; ++frame) {
        for (const BlockDraw& draw : flight.settle(look_from(2500.0 + 20.0 * frame, 40.0, 12.0, 1.0)).draws) {
            auto& [version, indices] = seen[draw.node->tile];
            if (version == draw.mesh->version) {
                EXPECT_EQ(indices, draw.mesh->indices);
                ++kept;
            } else {
                ++changed;
            }
            version = draw.mesh->version;
            indices = draw.mesh->indices;
        }
    }
    EXPECT_GT(changed, 20);
    EXPECT_GT(kept, 20);
}

TEST(BintreeLod, ABudgetIsUsedAndKeptWhereTheToleranceAsksForMore) {
    for (const std::uint32_t budget : {5000U, 10000U, 20000U}) {
        Flight flight{alps().database, budget};
        for (int frame = 0; frame < 20; ++frame) {
            const LodView view = look_from(2500.0, 40.0 + frame, 12.0, 0.1);
            const Selection& selection = flight.settle(view);
            expect_whole(selection, std::to_string(budget));
            EXPECT_LE(selection.triangles, budget) << "frame " << frame;
            EXPECT_GE(selection.triangles, budget * 9 / 10) << "frame " << frame;
        }
        const auto still = lists(flight.step(look_from(2500.0, 60.0, 12.0, 0.1)));
        const auto again = lists(flight.step(look_from(2500.0, 60.0, 12.0, 0.1)));
        EXPECT_EQ(again, still) << "a still eye";
    }
}

TEST(BintreeLod, ABudgetThatSufficesChangesNothing) {
    const LodView view = look_from(2500.0, 40.0, 12.0, 2.0);
    Flight free{alps().database}, bound{alps().database, 1000000};
    EXPECT_EQ(lists(bound.settle(view)), lists(free.settle(view)));
}

/// A node is there or not, split or not, wanted or not, by its code: bits in two sets a block. Two roots
/// whose leaves are n triangles have 2n - 2 nodes.
TEST(BintreeLod, AnActiveNodeTakesAtMost16Bytes) {
    for (const std::uint32_t budget : {0U, 20000U, 5000U}) {
        Flight flight{alps().database, budget};
        std::uint64_t nodes = 0, bits_bytes = 0, error_bytes = 0;
        for (const BlockDraw& draw : flight.settle(look_from(2500.0, 40.0, 12.0, 0.1)).draws) {
            nodes += std::uint64_t{draw.indices.count} / 3 * 2 - 2;
            bits_bytes += 2 * sizeof(bintree::CodeSet);
            error_bytes += sizeof(bintree::SplitVertices);
        }
        ASSERT_GT(nodes, 1000U);
        EXPECT_LE(bits_bytes, 16 * nodes) << "budget " << budget;
        // Errors are there for all posts of a block, however few of them a budget leaves.
        if (budget == 0) {
            EXPECT_LE(bits_bytes + error_bytes, 16 * nodes);
        }
        RecordProperty("milli_bytes_a_node_" + std::to_string(budget),
                       static_cast<int>(1000 * bits_bytes / nodes));
    }
}

}  // namespace
}  // namespace eyepoint::terrain
