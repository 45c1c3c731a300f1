/// HyperBlock-QuadTIN from a thousand random eyes, some inside blocks: no post is beyond tau + s, by block,
/// at every hyperLevel, and by vertex.
#include <gtest/gtest.h>

#include "tests/proof/proven_flight.hpp"
#include "tests/proof/random_walk.hpp"

namespace eyepoint::testing {
namespace {

using terrain::hyperblock::Options;
using terrain::hyperblock::SelectBy;

constexpr std::size_t kEyes = 1000;
constexpr double kTauPx = 1.0, kSlackPx = 0.1;
constexpr AnalyticTerrain kHills{.half_size_deg = 0.3, .detail_depth = 11};

class HyperblockProof : public ::testing::Test {
  protected:
    void expect_sound(const Options& options, const std::string& name) {
        ProvenFlight flight(database_, {.lod_method = "hyperblock", .hyperblock = options});
        RandomWalk walk(kHills, 20261122);
        std::vector<terrain::LodView> views;
        for (std::size_t i = 0; i < kEyes; ++i) views.push_back(walk.next(kTauPx, kSlackPx));
        const Findings findings = flight.fly(views, {.every = 1, .far_m = 40000.0, .pops = false});
        testing::expect_sound(findings, name);
        RecordProperty("posts_beyond", static_cast<int>(findings.beyond));
    }

    ScratchFolder scratch_;
    std::shared_ptr<const terrain::Database> database_ = make_database(kHills, scratch_.path() / "db");
};

TEST_F(HyperblockProof, ByBlockNothingIsBeyondTauAndSlack) { expect_sound({}, "by block"); }

TEST_F(HyperblockProof, ByBlockNothingIsBeyondTauAndSlackAtAnyHyperLevel) {
    for (const int hyper_level : {0, 1, 3})
        expect_sound({.hyper_level = hyper_level}, "hyperLevel " + std::to_string(hyper_level));
}

TEST_F(HyperblockProof, ByVertexNothingIsBeyondTauAndSlack) {
    expect_sound({.select_by = SelectBy::Vertex}, "by vertex");
}

}  // namespace
}  // namespace eyepoint::testing
