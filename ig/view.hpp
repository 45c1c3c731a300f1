/// A view: one eye, where it looks and how wide. Plain values, double precision.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace eyepoint::ig {

/// Where a picture is taken from and what it covers.
struct View {
    glm::dvec3 eye_ecef{0.0};
    /// Columns: right, up and backward (towards the viewer) unit vectors of the eye, in ECEF.
    glm::dmat3 axes{1.0};
    /// The view volume's tangents at distance 1 along the view axis: left < right, bottom < top.
    double left = -1.0, right = 1.0, bottom = -1.0, top = 1.0;
    int width_px = 0;
    int height_px = 0;
    /// Nearest distance drawn, metres; there is no far plane.
    double near_m = 0.5;

    /// kappa: pixels per unit of (metres over metres), on the vertical axis at the picture's centre.
    [[nodiscard]] double pixels_per_radian() const { return height_px / (top - bottom); }

    bool operator==(const View&) const = default;
};

}  // namespace eyepoint::ig
