/// The screen error of leaving a vertex out, and the test by it. Source: Ueng & Chuang, section 5, after
/// Lindstrom et al. 1996.
#pragma once

#include "terrain/lod/lod_method.hpp"
#include "terrain/lod/selective/block_posts.hpp"
#include "terrain/lod/selective/block_selection.hpp"
#include "terrain/lod/selective/selective_options.hpp"

namespace eyepoint::terrain::selective {

/// Where a view looks at a block from.
struct BlockView {
    glm::vec3 eye_m{0.0F};  ///< from BlockPosts::origin
    float kappa_px = 1.0F;
    float tau_px = 1.0F;
    float slack_px = 0.0F;
    float near_m = 0.0F;  ///< nothing nearer is drawn
    float box_m = 0.0F;   ///< distance of the box that the block lies in
};
[[nodiscard]] BlockView block_view(const LodView& view, const BlockPosts& posts, double box_m);

/// Screen error of leaving a vertex out, pixels.
[[nodiscard]] double error_px(ErrorFormula formula, const BlockPosts& posts, Rank rank,
                              const BlockView& view);
/// The height difference that has so many pixels, metres; infinite straight below the eye by the paper's
/// formula.
[[nodiscard]] double allowable_m(ErrorFormula formula, double kappa_px, double pixels, double horizontal_m,
                                 double distance_m);

/// The test of all of a block's vertices: those whose error is above tau fail. Fills in `tested`.
void test_posts(ErrorFormula formula, const BlockPosts& posts, const BlockView& view, TestedPosts& tested);

}  // namespace eyepoint::terrain::selective
