/// Views to choose for, without a renderer.
#pragma once

#include <cmath>

#include <glm/geometric.hpp>

#include "terrain/lod/lod_method.hpp"

namespace eyepoint::testing {

/// Half angles of a view volume, radians.
struct HalfAngles {
    double right = 0.5235987755982988;  ///< 30 degrees
    double top = 0.39269908169872414;   ///< 22.5 degrees
};

/// A view volume around a direction, 480 pixels high.
inline terrain::LodView look(const terrain::Ecef& eye, const glm::dvec3& forward, const glm::dvec3& up_hint,
                             double tau_px, double slack_px = 0.0, const HalfAngles& half = {}) {
    const glm::dvec3 f = glm::normalize(forward), r = glm::normalize(glm::cross(f, up_hint)),
                     u = glm::cross(r, f);
    const double right = std::tan(half.right), top = std::tan(half.top);
    return {.eye = eye,
            .sides = {glm::normalize(r + f * right), glm::normalize(-r + f * right),
                      glm::normalize(u + f * top), glm::normalize(-u + f * top)},
            .kappa_px = 480.0 / (2.0 * top),
            .tau_px = tau_px,
            .slack_px = slack_px,
            .near_m = 0.5};
}

}  // namespace eyepoint::testing
