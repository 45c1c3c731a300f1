/// How far below the true surface a drawn one may lie: what the curve of the Earth hides is judged by that.
#pragma once

#include "terrain/lod/lod_method.hpp"

namespace eyepoint::terrain {

/// How far below the true surface a mesh drawn within tolerance and slack may lie between the eye and its
/// horizon, metres: tau + s pixels at the horizon's distance, twice over for the strips beside thinned edges.
/// Only what an Earth lower by this hides is hidden by drawn meshes: else the sky would show between the last
/// one before the horizon and a mountain behind it. lowest_height_m: lowest ellipsoidal height of all
/// terrain.
[[nodiscard]] double mesh_below_surface_m(const LodView& view, double lowest_height_m);

}  // namespace eyepoint::terrain
