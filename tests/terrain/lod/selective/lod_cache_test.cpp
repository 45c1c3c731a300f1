#include "terrain/lod/selective/lod_cache.hpp"

#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "terrain/lod/selective/screen_error.hpp"

namespace eyepoint::terrain::selective {
namespace {

/// A block of 1,320 m, flat, its middle at the origin; z is up.
constexpr double kHalfM = 660.0;
const std::array<Ecef, 4> kCorners{
    {{-kHalfM, -kHalfM, 0.0}, {kHalfM, -kHalfM, 0.0}, {-kHalfM, kHalfM, 0.0}, {kHalfM, kHalfM, 0.0}}};
constexpr glm::dvec3 kUp{0.0, 0.0, 1.0};

SelectedFor selected_at(const Ecef& eye) {
    return {.eye = eye, .kappa_px = 1099.0, .tau_px = 1.0, .slack_px = 0.1};
}
bool stands(const Ecef& e0, const Ecef& e1, ErrorFormula formula = ErrorFormula::Paper) {
    return four_corner_test(formula, kCorners, kUp, selected_at(e0), e1);
}

TEST(FourCornerTest, StandsForAStillEyeAndSmallMoves) {
    for (const ErrorFormula formula : {ErrorFormula::Paper, ErrorFormula::Bound}) {
        EXPECT_TRUE(stands({5000.0, 0.0, 1000.0}, {5000.0, 0.0, 1000.0}, formula));
        EXPECT_TRUE(stands({5000.0, 0.0, 1000.0}, {4900.0, 50.0, 1010.0}, formula));
    }
}

TEST(FourCornerTest, FailsForLargeMovesEitherWay) {
    for (const ErrorFormula formula : {ErrorFormula::Paper, ErrorFormula::Bound}) {
        EXPECT_FALSE(stands({5000.0, 0.0, 1000.0}, {4000.0, 0.0, 1000.0}, formula));
        EXPECT_FALSE(stands({5000.0, 0.0, 1000.0}, {6000.0, 0.0, 1000.0}, formula));
    }
}

/// Where allowable height differences are a tenth of the slack's of each other at all corners: the eye has
/// moved by a tenth of its distance, less what the block is wide.
TEST(FourCornerTest, ByDistanceAloneItIsTheShareOfTheSlack) {
    const Ecef e0{100000.0, 0.0, 0.0};
    EXPECT_TRUE(stands(e0, {100000.0 - 9900.0, 0.0, 0.0}, ErrorFormula::Bound));
    EXPECT_FALSE(stands(e0, {100000.0 - 10100.0, 0.0, 0.0}, ErrorFormula::Bound));
}

TEST(FourCornerTest, StraightAboveACornerNothingIsKnown) {
    EXPECT_FALSE(stands({kHalfM, kHalfM, 1000.0}, {kHalfM, kHalfM, 1000.0}));
}

/// The paper's claim for a vertex: kept while the allowable height difference changes by less than what s is
/// there, its error is below tau + s.
TEST(FourCornerTest, AVertexKeptByItsOwnTestIsWithinTauAndSlack) {
    const double kappa_px = 1099.0, tau_px = 1.0, slack_px = 0.1;
    for (double h0 = 300.0; h0 < 20000.0; h0 *= 1.7) {
        for (double step_m = -400.0; step_m <= 400.0; step_m += 25.0) {
            const double h1 = h0 + step_m, above_m = 1000.0;
            if (h1 <= 0.0) continue;
            const double d0 = std::hypot(h0, above_m), d1 = std::hypot(h1, above_m);
            const double then_m = allowable_m(ErrorFormula::Paper, kappa_px, tau_px, h0, d0),
                         now_m = allowable_m(ErrorFormula::Paper, kappa_px, tau_px, h1, d1),
                         slack_m = allowable_m(ErrorFormula::Paper, kappa_px, slack_px, h0, d0);
            if (std::abs(now_m - then_m) >= slack_m) continue;
            // Just passed then.
            const double error_now_px = kappa_px * then_m * h1 / (d1 * d1);
            EXPECT_LT(error_now_px, tau_px / (1.0 - slack_px / tau_px) + 1e-9);
        }
    }
}

TEST(SameScale, StandsWhereErrorsHaveFewerPixelsButNotMore) {
    const SelectedFor selected = selected_at({});
    const auto at = [&](double kappa_px, double tau_px) {
        return same_scale(selected, {.kappa_px = kappa_px, .tau_px = tau_px, .slack_px = 0.1 * tau_px});
    };
    EXPECT_TRUE(at(1099.0, 1.0));
    EXPECT_TRUE(at(1099.0, 1.05));
    EXPECT_FALSE(at(1099.0, 1.3)) << "far too many triangles";
    EXPECT_FALSE(at(1099.0, 0.99));
    EXPECT_FALSE(at(1150.0, 1.0)) << "a narrower field of view";
    EXPECT_FALSE(same_scale({}, {.kappa_px = 1099.0, .tau_px = 1.0})) << "nothing was selected yet";
}

}  // namespace
}  // namespace eyepoint::terrain::selective
