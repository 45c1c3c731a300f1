#include "terrain/lod/cell_cut.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "terrain/geodesy/earth.hpp"
#include "terrain/lod/nested.hpp"
#include "terrain/lod/nested_motion.hpp"
#include "tests/support/analytic_terrain.hpp"
#include "tests/terrain/lod/look.hpp"
#include "tests/terrain/lod/nested_mesh.hpp"
#include "tests/terrain/lod/pattern_planet.hpp"

namespace eyepoint::terrain {
namespace {

using testing::drawn_triangles;
using testing::DrawnTriangle;
using testing::PointBits;

/// A view volume of 40 by 30 degrees or so, anywhere about the Alps, looking anyhow.
LodView random_view(std::mt19937_64& random) {
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    const double latitude_deg = 45.5 + 2.0 * unit(random), longitude_deg = 7.25 + 2.0 * unit(random);
    const double above_m = std::pow(10.0, 2.5 + 3.5 * unit(random));
    const double course = 6.283 * unit(random), down = 1.5 * unit(random) * unit(random);
    const double bank = 2.0 * unit(random) - 1.0;
    const glm::dmat3 enu = east_north_up(latitude_deg, longitude_deg);
    const glm::dvec3 f = enu * glm::dvec3{std::sin(course) * std::cos(down),
                                          std::cos(course) * std::cos(down), -std::sin(down)};
    const double tau_px = std::exp2(3.0 * unit(random) - 2.0);
    return testing::look(to_ecef({latitude_deg, longitude_deg, EllipsoidalHeight{above_m}}), f,
                         enu * glm::dvec3{std::sin(bank), 0.1, std::cos(bank)}, tau_px,
                         0.2 * unit(random) * tau_px, {.right = 0.35, .top = 0.26});
}

glm::dvec3 point(const PointBits& bits) {
    return {std::bit_cast<float>(bits[0]), std::bit_cast<float>(bits[1]), std::bit_cast<float>(bits[2])};
}

/// Drawn triangles, without those wholly outside one side of the view.
std::vector<DrawnTriangle> triangles_in_view(const Selection& selection, const LodView& view) {
    auto triangles = drawn_triangles(selection.draws, motion_view(view));
    std::erase_if(triangles, [&](const DrawnTriangle& triangle) {
        return std::any_of(view.sides.begin(), view.sides.end(), [&](const glm::dvec3& side) {
            return std::all_of(triangle.corners.begin(), triangle.corners.end(),
                               [&](const PointBits& corner) { return glm::dot(side, point(corner)) < 0.0; });
        });
    });
    return triangles;
}

std::uint64_t triangles_of(const Selection& selection) {
    std::uint64_t triangles = 0;
    for (const BlockDraw& draw : selection.draws) triangles += draw.indices.count / 3;
    return triangles;
}

class CellCutTest : public ::testing::Test {
  protected:
    static void SetUpTestSuite() {
        scratch_ = std::make_unique<testing::ScratchFolder>();
        database_ = testing::make_pattern_database({}, scratch_->path() / "db");
    }
    static void TearDownTestSuite() {
        database_.reset();
        scratch_.reset();
    }

    CellCutTest() : pager_(Pager::create(database_, {.threads = 2, .mesh = MeshKind::Nested}).value()) {}

    /// Draws of whole blocks; with everything loaded that the view asks for, or not.
    const Selection& select_whole(const LodView& view, bool loaded = true) {
        while (true) {
            pager_->publish(loaded ? 100000 : 5, frame_);
            const Selection& selection = whole_.select(view, pager_->tree(), ++frame_);
            pager_->request(selection.wishes);
            const bool waited = pager_->wait_for_loads();
            if (!loaded || !waited) return selection;
        }
    }
    /// Any side may cut any block: that some do not is for speed alone.
    static Selection cut(const LodView& view, const Selection& whole, std::uint8_t sides) {
        const std::vector<std::uint8_t> of_draws(whole.draws.size(), sides);
        return CellCut().cut(view, of_draws, whole);
    }

    static std::unique_ptr<testing::ScratchFolder> scratch_;
    static std::shared_ptr<const Database> database_;
    std::unique_ptr<Pager> pager_;
    NestedLod whole_{true, false, false};
    std::uint64_t frame_ = 0;
};
std::unique_ptr<testing::ScratchFolder> CellCutTest::scratch_;
std::shared_ptr<const Database> CellCutTest::database_;

TEST_F(CellCutTest, CellsOfAnyLevelsDrawTheSurfaceOfWholeBlocks) {
    std::mt19937_64 random(5);
    std::uint64_t whole_triangles = 0, cut_triangles = 0;
    for (int i = 0; i < 24; ++i) {
        const LodView view = random_view(random);
        const Selection& whole = select_whole(view);
        const Selection cells = cut(view, whole, 0);
        const MotionView motion = motion_view(view);
        ASSERT_TRUE(drawn_triangles(cells.draws, motion) == drawn_triangles(whole.draws, motion)) << i;
        EXPECT_EQ(cells.triangles, triangles_of(cells));
        whole_triangles += whole.triangles;
        cut_triangles += cells.triangles;
    }
    EXPECT_LT(cut_triangles, whole_triangles);
}

TEST_F(CellCutTest, LeavesOutNothingInView) {
    std::mt19937_64 random(6);
    std::uint64_t whole_triangles = 0, cut_triangles = 0, seen = 0;
    for (int i = 0; i < 40; ++i) {
        const LodView view = random_view(random);
        const Selection& whole = select_whole(view);
        const Selection cells = cut(view, whole, 0xf);
        const auto expected = triangles_in_view(whole, view);
        ASSERT_TRUE(triangles_in_view(cells, view) == expected) << i;
        EXPECT_EQ(cells.triangles, triangles_of(cells));
        seen += expected.size();
        whole_triangles += whole.triangles;
        cut_triangles += cells.triangles;
    }
    EXPECT_GT(seen, 5000U);
    EXPECT_LT(cut_triangles * 10, whole_triangles * 9);
}

TEST_F(CellCutTest, LeavesOutNothingInViewWhileBlocksAreMissing) {
    std::mt19937_64 random(7);
    std::size_t floors = 0;
    for (int i = 0; i < 6; ++i) {
        const LodView view = random_view(random);
        for (int frame = 0; frame < 30; ++frame) {
            const Selection& whole = select_whole(view, false);
            ASSERT_TRUE(triangles_in_view(cut(view, whole, 0xf), view) == triangles_in_view(whole, view));
            floors += static_cast<std::size_t>(
                std::count_if(whole.draws.begin(), whole.draws.end(),
                              [](const BlockDraw& draw) { return draw.floors != EdgeFloors{}; }));
            if (whole.wishes.empty()) break;
        }
    }
    EXPECT_GT(floors, 0U);
}

/// The method's own cut, with what it knows of the sides.
TEST_F(CellCutTest, TheMethodCutsItsBlocksByDefault) {
    std::mt19937_64 random(8);
    NestedLod method;
    std::uint64_t whole_triangles = 0, cut_triangles = 0;
    for (int i = 0; i < 12; ++i) {
        const LodView view = random_view(random);
        const Selection whole = select_whole(view);
        const Selection& cells = method.select(view, pager_->tree(), ++frame_);
        ASSERT_TRUE(triangles_in_view(cells, view) == triangles_in_view(whole, view)) << i;
        whole_triangles += whole.triangles;
        cut_triangles += cells.triangles;
    }
    EXPECT_LT(cut_triangles, whole_triangles);
}

}  // namespace
}  // namespace eyepoint::terrain
