/// Seeded random walks over analytic terrain: the methods nested, selective and hyperblock keep to the
/// tolerance; bintree and tile have no such bound, and their meshes are as whole.
#include <algorithm>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/proof/proven_flight.hpp"
#include "tests/proof/random_walk.hpp"

namespace eyepoint::testing {
namespace {

struct WalkPlace {
    std::string name;
    AnalyticTerrain terrain;
    std::string lod_method = "nested";
};
void PrintTo(const WalkPlace& place, std::ostream* out) { *out << place.name; }

class WalkProof : public ::testing::TestWithParam<WalkPlace> {
  protected:
    /// The tolerance changes from leg to leg.
    [[nodiscard]] static std::vector<terrain::LodView> walk(std::uint64_t seed, std::size_t legs) {
        RandomWalk random_walk(GetParam().terrain, seed);
        std::vector<terrain::LodView> views;
        for (std::size_t leg = 0; leg < legs; ++leg) {
            const Tolerance& tolerance = kTolerances[leg * 5 % kTolerances.size()];
            for (int i = 0; i < RandomWalk::kLegViews; ++i)
                views.push_back(random_walk.next(tolerance.tau_px, tolerance.slack_share * tolerance.tau_px));
        }
        return views;
    }

    ScratchFolder scratch_;
    std::shared_ptr<const terrain::Database> database_ =
        make_database(GetParam().terrain, scratch_.path() / "db");
};

TEST_P(WalkProof, IsWholeAndWithinItsBounds) {
    ProvenFlight flight(database_, {.lod_method = GetParam().lod_method});
    const auto views = walk(20261122, every_frame() ? 240 : 24);
    const Findings findings = flight.fly(views, {.every = one_in(4), .far_m = 40000.0, .pops = false});
    if (GetParam().lod_method == "bintree" || GetParam().lod_method == "tile")
        expect_whole(findings, GetParam().name);
    else
        expect_sound(findings, GetParam().name);
}

TEST_P(WalkProof, IsWholeWhileAFewBlocksArriveAFrame) {
    const auto views = walk(7, every_frame() ? 60 : 6);
    EXPECT_GT(expect_whole_while_loading(database_, views, 5, one_in(9), GetParam().lod_method),
              std::min<std::size_t>(views.size() / 2, 40));
}

constexpr AnalyticTerrain kHills{.half_size_deg = 0.3, .detail_depth = 11};
constexpr AnalyticTerrain kAntimeridian{
    .latitude_deg = -17.0, .longitude_deg = 180.0, .half_size_deg = 0.3, .detail_depth = 11};
constexpr AnalyticTerrain kPole{.latitude_deg = 90.0, .half_size_deg = 0.4, .detail_depth = 9};

INSTANTIATE_TEST_SUITE_P(
    Earth, WalkProof,
    ::testing::Values(WalkPlace{"Hills", kHills}, WalkPlace{"Antimeridian", kAntimeridian},
                      WalkPlace{"Pole", kPole}, WalkPlace{"HillsBintree", kHills, "bintree"},
                      WalkPlace{"AntimeridianBintree", kAntimeridian, "bintree"},
                      WalkPlace{"PoleBintree", kPole, "bintree"}, WalkPlace{"HillsTile", kHills, "tile"},
                      WalkPlace{"AntimeridianTile", kAntimeridian, "tile"},
                      WalkPlace{"PoleTile", kPole, "tile"}, WalkPlace{"HillsSelective", kHills, "selective"},
                      WalkPlace{"AntimeridianSelective", kAntimeridian, "selective"},
                      WalkPlace{"PoleSelective", kPole, "selective"},
                      WalkPlace{"HillsHyperblock", kHills, "hyperblock"},
                      WalkPlace{"AntimeridianHyperblock", kAntimeridian, "hyperblock"},
                      WalkPlace{"PoleHyperblock", kPole, "hyperblock"}),
    [](const auto& instance) { return instance.param.name; });

}  // namespace
}  // namespace eyepoint::testing
