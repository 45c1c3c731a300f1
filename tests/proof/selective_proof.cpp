/// Ueng & Chuang's method from a thousand random eyes, some inside blocks: with the sound reuse test no
/// vertex and no post is beyond tau + s; what the paper's tests let through is measured.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/proof/thousand_eyes.hpp"

namespace eyepoint::testing {
namespace {

using terrain::selective::ErrorFormula;
using terrain::selective::ReuseTest;

class SelectiveProof : public ThousandEyes {
  protected:
    static Findings fly(ErrorFormula error, ReuseTest reuse, const std::string& name) {
        const Findings findings = ThousandEyes::fly({.lod_method = "selective", .selective = {error, reuse}});
        expect_whole(findings, name);
        const terrain::SelectionAudit& audit = findings.figures.audit;
        fmt::print("{}: {} vertices, {} missed, {} beyond tau + s, worst {:.3f} px\n", name, audit.selected,
                   audit.missed, audit.too_far, audit.worst_px);
        RecordProperty("missed_vertices", static_cast<int>(audit.missed));
        RecordProperty("vertices_beyond", static_cast<int>(audit.too_far));
        return findings;
    }
};

TEST_F(SelectiveProof, WithTheSoundTestNothingIsBeyondTauAndSlack) {
    const Findings findings = fly(ErrorFormula::Bound, ReuseTest::Sound, "sound");
    EXPECT_EQ(findings.figures.audit.too_far, 0U);
    EXPECT_EQ(findings.beyond, 0U);
}

TEST_F(SelectiveProof, WithTheSoundTestAndThePapersFormulaNoVertexIsBeyondTauAndSlack) {
    EXPECT_EQ(fly(ErrorFormula::Paper, ReuseTest::Sound, "sound, paper's error").figures.audit.too_far, 0U);
}

TEST_F(SelectiveProof, WithTheFourCornerTestTheMeshIsWhole) {
    (void)fly(ErrorFormula::Bound, ReuseTest::FourCorner, "four corners");
    (void)fly(ErrorFormula::Paper, ReuseTest::FourCorner, "four corners, paper's error");
}

TEST_F(SelectiveProof, WithoutACacheNoVertexIsMissed) {
    EXPECT_EQ(fly(ErrorFormula::Bound, ReuseTest::Off, "uncached").figures.audit.missed, 0U);
    EXPECT_EQ(fly(ErrorFormula::Paper, ReuseTest::Off, "uncached, paper's error").figures.audit.missed, 0U);
}

}  // namespace
}  // namespace eyepoint::testing
