#include "terrain/lod/selective/lod_cache.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

#include "terrain/lod/selective/screen_error.hpp"

namespace eyepoint::terrain::selective {

bool four_corner_test(ErrorFormula formula, const std::array<Ecef, 4>& corners, const glm::dvec3& up,
                      const SelectedFor& selected, const Ecef& eye) {
    const auto allow_m = [&](const Ecef& from, const Ecef& vertex, double pixels) {
        const glm::dvec3 to = vertex - from;
        const double above_m = glm::dot(to, up);
        const double horizontal_m = std::sqrt(std::max(glm::dot(to, to) - above_m * above_m, 0.0));
        return allowable_m(formula, selected.kappa_px, pixels, horizontal_m, glm::length(to));
    };
    double greatest_change_m = 0.0, least_slack_m = std::numeric_limits<double>::infinity();
    for (const Ecef& corner : corners) {
        const double then_m = allow_m(selected.eye, corner, selected.tau_px),
                     now_m = allow_m(eye, corner, selected.tau_px);
        if (!std::isfinite(then_m) || !std::isfinite(now_m)) return false;
        greatest_change_m = std::max(greatest_change_m, std::abs(now_m - then_m));
        least_slack_m = std::min(least_slack_m, allow_m(selected.eye, corner, selected.slack_px));
    }
    return greatest_change_m < least_slack_m;
}

bool same_scale(const SelectedFor& selected, const LodView& view) {
    if (selected.kappa_px == view.kappa_px && selected.tau_px == view.tau_px &&
        selected.slack_px == view.slack_px)
        return true;
    if (selected.tau_px == 0.0) return false;
    constexpr double kLeastRatio = 0.9;
    const double then = selected.kappa_px / (selected.tau_px + selected.slack_px),
                 now = view.kappa_px / (view.tau_px + view.slack_px);
    return now <= then && now >= kLeastRatio * then;
}

}  // namespace eyepoint::terrain::selective
