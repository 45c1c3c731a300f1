/// HyperBlock-QuadTIN from a thousand random eyes, some inside blocks: no post is beyond tau + s, by block,
/// at every hyperLevel, and by vertex.
#include <gtest/gtest.h>

#include "tests/proof/thousand_eyes.hpp"

namespace eyepoint::testing {
namespace {

using terrain::hyperblock::Options;
using terrain::hyperblock::SelectBy;

class HyperblockProof : public ThousandEyes {
  protected:
    static void expect_sound(const Options& options, const std::string& name) {
        testing::expect_sound(fly({.lod_method = "hyperblock", .hyperblock = options}), name);
    }
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
