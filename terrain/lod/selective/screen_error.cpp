// Built with -fno-math-errno and -fno-trapping-math, so that the loops over posts do four at once.
#include "terrain/lod/selective/screen_error.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include <glm/geometric.hpp>

#include "terrain/lod/tile_cut.hpp"

namespace eyepoint::terrain::selective {

namespace {

constexpr float kEver = std::numeric_limits<float>::max();

/// How far away an error of a metre may be seen, metres: at tau, and at tau + s.
struct Reach {
    explicit Reach(const BlockView& view)
        : per_metre(view.kappa_px / view.tau_px), slackened(view.tau_px / (view.tau_px + view.slack_px)) {}
    float per_metre;
    float slackened;  ///< the second as a share of the first
};

void test_by_bound(const BlockPosts& posts, const BlockView& view, TestedPosts& tested) {
    const Reach reach(view);
    const glm::vec3 eye = view.eye_m;
    const float arc_per_metre = view.kappa_px / static_cast<float>(kHorizonPx), near_m = view.near_m,
                box_m = view.box_m;
    for (std::size_t i = 0; i < kRanks; ++i) {
        const float dx = posts.x[i] - eye.x, dy = posts.y[i] - eye.y, dz = posts.z[i] - eye.z;
        const float metres = std::sqrt(dx * dx + dy * dy + dz * dz) - posts.radius_m[i];
        const float distance_m = metres > box_m ? metres : box_m;
        const float shape_reach_m = posts.bound_m[i] * reach.per_metre,
                    arc_reach_m = posts.arc_m[i] * arc_per_metre;
        const float greater_m = shape_reach_m > arc_reach_m ? shape_reach_m : arc_reach_m;
        const float reach_m = greater_m > near_m ? greater_m : 0.0F;
        const float stands_m = distance_m - reach_m * reach.slackened;
        tested.passes_by[i] = distance_m - reach_m;
        tested.stands_for_m[i] = reach_m > 0.0F ? stands_m : kEver;
    }
}

/// Without a division: kappa delta h <= tau D^2, both sides squared.
void test_by_paper(const BlockPosts& posts, const BlockView& view, TestedPosts& tested) {
    const Reach reach(view);
    const glm::vec3 eye = view.eye_m, up = posts.up;
    for (std::size_t i = 0; i < kRanks; ++i) {
        const float dx = posts.x[i] - eye.x, dy = posts.y[i] - eye.y, dz = posts.z[i] - eye.z;
        const float above_m = dx * up.x + dy * up.y + dz * up.z;
        const float squared = dx * dx + dy * dy + dz * dz;
        const float reach_m = posts.delta_m[i] * reach.per_metre;
        tested.passes_by[i] = squared * squared - reach_m * reach_m * (squared - above_m * above_m);
        tested.stands_for_m[i] = std::sqrt(squared) - reach_m * reach.slackened;
    }
}

}  // namespace

BlockView block_view(const LodView& view, const BlockPosts& posts, double box_m) {
    return {.eye_m = glm::vec3{view.eye - posts.origin},
            .kappa_px = static_cast<float>(view.kappa_px),
            .tau_px = static_cast<float>(view.tau_px),
            .slack_px = static_cast<float>(view.slack_px),
            .near_m = static_cast<float>(view.near_m),
            .box_m = static_cast<float>(box_m)};
}

double error_px(ErrorFormula formula, const BlockPosts& posts, Rank rank, const BlockView& view) {
    const glm::dvec3 to = glm::dvec3{posts.x[rank], posts.y[rank], posts.z[rank]} - glm::dvec3{view.eye_m};
    const double metres = glm::length(to);
    if (formula == ErrorFormula::Paper) {
        const double above_m = glm::dot(to, glm::dvec3{posts.up});
        const double horizontal_m = std::sqrt(std::max(metres * metres - above_m * above_m, 0.0));
        return view.kappa_px * posts.delta_m[rank] * horizontal_m / (metres * metres);
    }
    const double nearest_m =
        std::max({metres - posts.radius_m[rank], double{view.box_m}, double{view.near_m}});
    const double arc_px = view.kappa_px * posts.arc_m[rank] / nearest_m;
    return std::max(view.kappa_px * posts.bound_m[rank] / nearest_m, arc_px * view.tau_px / kHorizonPx);
}

double allowable_m(ErrorFormula formula, double kappa_px, double pixels, double horizontal_m,
                   double distance_m) {
    if (formula == ErrorFormula::Bound) return pixels * distance_m / kappa_px;
    return pixels * distance_m * distance_m / (kappa_px * horizontal_m);
}

void test_posts(ErrorFormula formula, const BlockPosts& posts, const BlockView& view, TestedPosts& tested) {
    formula == ErrorFormula::Bound ? test_by_bound(posts, view, tested) : test_by_paper(posts, view, tested);
}

}  // namespace eyepoint::terrain::selective
