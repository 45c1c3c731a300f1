/// When a block's selection may be used again. Source: Ueng & Chuang, section 5; the sound bound is ours.
#pragma once

#include <array>

#include "terrain/lod/lod_method.hpp"
#include "terrain/lod/selective/selective_options.hpp"

namespace eyepoint::terrain::selective {

/// The view that a block's selection was made for.
struct SelectedFor {
    Ecef eye{0.0};
    double kappa_px = 0.0, tau_px = 0.0, slack_px = 0.0;  ///< zero: there is none
    double stands_to_m = 0.0;                             ///< Sound: odometer up to which it stands
};

/// By the paper, a vertex's selection at e0 may be kept at e1 while its allowable height difference has
/// changed by less than what s is there: |allow(e1, v) - allow(e0, v)| < allow_s(e0, v). The block's is kept
/// while that holds for the greatest change at the four corners and the least allow_s at the four. up: unit.
[[nodiscard]] bool four_corner_test(ErrorFormula formula, const std::array<Ecef, 4>& corners,
                                    const glm::dvec3& up, const SelectedFor& selected, const Ecef& eye);

/// Whether a selection made for another scale of errors stands at this one: where pixels are no more (sound),
/// and not so many fewer that it would have far too many triangles.
[[nodiscard]] bool same_scale(const SelectedFor& selected, const LodView& view);

}  // namespace eyepoint::terrain::selective
