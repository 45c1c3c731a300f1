/// The method tile in flight: its drawn mesh, vertices as the shader slides them, frame by frame.
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "terrain/lod/tile/tile_lod.hpp"
#include "tests/tools/bench/small_flight.hpp"
#include "tools/bench/measure/mesh_faults.hpp"

namespace eyepoint::testing {
namespace {

using terrain::LodView;
using terrain::Selection;
using terrain::tiles::MorphClock;

constexpr double kRateHz = 30.0, kTauPx = 3.0;

/// Straight north over the hills, 600 m above their middle height, 20 m a frame.
std::vector<LodView> flight(int frames) {
    std::vector<LodView> views;
    for (int i = 0; i < frames; ++i) {
        views.push_back(look_north(46.38 + 1.8e-4 * i, 8.25, 1600.0, 10.0, kTauPx));
        views.back().time_s = i / kRateHz;
        views.back().drawn_frame = static_cast<std::uint64_t>(i);
    }
    return views;
}

std::unique_ptr<tools::LodFlight> tiles_over_hills(const terrain::tiles::Options& options) {
    return tools::LodFlight::create(small_hills(), {.lod_method = "tile", .tile = options}).value();
}

const terrain::TileLod& method_of(const tools::LodFlight& flight) {
    return dynamic_cast<const terrain::TileLod&>(flight.method());
}

/// A selection's draws, to be compared: tile, first index, slide.
using Draws = std::vector<std::tuple<terrain::TileId, std::uint32_t, terrain::TileSlide>>;

Draws draws_of(const Selection& selection) {
    Draws draws;
    for (const terrain::BlockDraw& draw : selection.draws)
        draws.emplace_back(draw.node->tile, draw.indices.first, draw.slide);
    return draws;
}

bool slides(const Selection& selection) {
    return std::any_of(selection.draws.begin(), selection.draws.end(),
                       [](const terrain::BlockDraw& draw) { return draw.slide.slid > 0; });
}

struct Way {
    const char* name;
    terrain::tiles::Options options;
};
void PrintTo(const Way& way, std::ostream* out) { *out << way.name; }

class TilesInFlight : public ::testing::TestWithParam<Way> {};

TEST_P(TilesInFlight, AreOneMeshInEveryFrame) {
    const auto flown = tiles_over_hills(GetParam().options);
    int sliding = 0;
    for (const LodView& view : flight(60)) {
        (void)flown->settle(view);
        const Selection& selection = flown->select(view);
        const tools::MeshFaults faults =
            find_mesh_faults(tools::drawn_mesh(selection, flown->method(), view));
        ASSERT_GT(faults.edges, 1000U);
        ASSERT_EQ(faults.cracks, 0U) << "at " << view.time_s << " s";
        ASSERT_EQ(faults.overlaps, 0U) << "at " << view.time_s << " s";
        sliding += slides(selection) ? 1 : 0;
    }
    EXPECT_EQ(sliding > 20, GetParam().options.morph) << sliding << " frames with morphs";
}

TEST_P(TilesInFlight, AStillEyeSeesTheSame) {
    if (GetParam().options.clock != MorphClock::Distance) return;
    const auto flown = tiles_over_hills(GetParam().options);
    const auto views = flight(40);
    for (const LodView& view : views) (void)flown->settle(view);
    const Draws before = draws_of(flown->select(views.back()));
    for (int i = 0; i < 5; ++i) EXPECT_TRUE(draws_of(flown->select(views.back())) == before) << "frame " << i;
}

INSTANTIATE_TEST_SUITE_P(Ways, TilesInFlight,
                         ::testing::Values(Way{"Of9", {.posts = 9}}, Way{"Of17", {.posts = 17}},
                                           Way{"Of33", {.posts = 33}},
                                           Way{"Of17WithoutMorph", {.posts = 17, .morph = false}},
                                           Way{"Of33WithoutMorph", {.posts = 33, .morph = false}},
                                           Way{"ByTime", {.clock = MorphClock::Time}},
                                           Way{"ByFrames", {.clock = MorphClock::Frames}},
                                           Way{"OneAFrame", {.rebuilds = 1}}),
                         [](const auto& way) { return std::string(way.param.name); });

TEST(TileQueue, NoMoreTilesChangeLevelInAFrameThanItIsGiven) {
    // A tolerance that falls by 2% a frame makes many tiles want another level at once.
    auto views = flight(60);
    for (std::size_t i = 1; i < views.size(); ++i) views[i].tau_px = 0.98 * views[i - 1].tau_px;
    for (const std::uint32_t rebuilds : {1U, 3U}) {
        const auto flown = tiles_over_hills({.posts = 9, .rebuilds = rebuilds});
        for (const LodView& view : views) (void)flown->settle(view);
        (void)flown->settle(views.front());
        std::uint32_t most = 0;
        for (const LodView& view : views) {
            (void)flown->select(view);
            most = std::max(most, method_of(*flown).switched());
        }
        EXPECT_EQ(most, rebuilds) << "and some frames have as many waiting";
    }
}

/// Flies to a place and stays about there until nothing is under way, and then some: blocks give way to their
/// parents one depth after the other.
Draws arrived(const terrain::tiles::Options& options) {
    const auto flown = tiles_over_hills(options);
    const auto views = flight(50);
    for (const LodView& view : views) (void)flown->settle(view);
    LodView view = views.back();
    int settled = 0;
    for (int i = 1; i < 20000; ++i) {
        const bool there = i % 2 == 0;
        view = there ? views.back() : look_north(46.38 + 1.8e-4 * 49 + 9e-5, 8.25, 1600.0, 10.0, kTauPx);
        view.time_s = views.back().time_s + i / kRateHz;
        view.drawn_frame = views.back().drawn_frame + static_cast<std::uint64_t>(i);
        const Selection& selection = flown->settle(view);
        settled = method_of(*flown).unsettled() == 0 ? settled + 1 : 0;
        if (there && settled > 20) return draws_of(selection);
    }
    ADD_FAILURE() << "there is still a morph under way";
    return {};
}

TEST(TileMorph, EndsInTheSameMeshByDistanceTimeAndFramesAndWithoutIt) {
    const Draws without = arrived({.morph = false});
    ASSERT_FALSE(without.empty());
    EXPECT_TRUE(arrived({.clock = MorphClock::Distance}) == without);
    EXPECT_TRUE(arrived({.clock = MorphClock::Time}) == without);
    EXPECT_TRUE(arrived({.clock = MorphClock::Frames}) == without);
}

/// The largest jump of a post from one frame to the next, pixels.
double largest_jump_px(bool morph) {
    const auto flown = tiles_over_hills({.morph = morph});
    tools::FullSurface surface(small_hills());
    const auto views = flight(40);
    for (const LodView& view : views) (void)flown->settle(view);
    (void)flown->settle(views.front());
    std::optional<tools::MeasuredPosts> before;
    double largest_px = 0.0;
    for (const LodView& view : views) {
        const tools::DrawnMesh mesh = tools::drawn_mesh(flown->select(view), flown->method(), view);
        auto posts = tools::measure_posts(surface, mesh, {view, 20000.0}).value();
        if (before) largest_px = std::max(largest_px, tools::pops(*before, posts).maximum());
        before = std::move(posts);
    }
    return largest_px;
}

TEST(TileMorph, PostsDoNotJump) {
    const double with_px = largest_jump_px(true), without_px = largest_jump_px(false);
    EXPECT_GT(without_px, 0.5);
    EXPECT_LT(with_px, 0.3 * without_px);
}

}  // namespace
}  // namespace eyepoint::testing
