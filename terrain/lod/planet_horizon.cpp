#include "terrain/lod/planet_horizon.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "terrain/geodesy/earth.hpp"

namespace eyepoint::terrain {

double mesh_below_surface_m(const LodView& view, double lowest_height_m) {
    const double eye_radius_m = glm::length(view.eye), surface_radius_m = kPolarRadiusM + lowest_height_m;
    double below_m = 0.0;
    // The lower Earth's horizon is farther: three rounds settle it to the metre.
    for (int i = 0; i < 3; ++i) {
        const double radius_m = surface_radius_m - below_m;
        const double horizon_m = std::sqrt(std::max(eye_radius_m * eye_radius_m - radius_m * radius_m, 0.0));
        below_m = 2.0 * (view.tau_px + view.slack_px) / view.kappa_px * horizon_m;
    }
    return std::min(below_m, 0.5 * surface_radius_m);
}

}  // namespace eyepoint::terrain
