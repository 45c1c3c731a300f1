#include "ig/lod_view.hpp"

#include <glm/geometric.hpp>

namespace eyepoint::ig {

terrain::LodView lod_view(const View& view, double tau_px, double slack_px) {
    const auto inward = [&](const glm::dvec3& normal) { return view.axes * glm::normalize(normal); };
    return {.eye = view.eye_ecef,
            .sides = {inward({1.0, 0.0, view.left}), inward({-1.0, 0.0, -view.right}),
                      inward({0.0, 1.0, view.bottom}), inward({0.0, -1.0, -view.top})},
            .kappa_px = view.pixels_per_radian(),
            .tau_px = tau_px,
            .slack_px = slack_px,
            .near_m = view.near_m};
}

}  // namespace eyepoint::ig
