/// Where a tile's surface is: a box to measure distance and test frusta against, and a cone against the
/// horizon.
#pragma once

#include <array>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "terrain/geodesy/position.hpp"
#include "terrain/tiling/tile_id.hpp"

namespace eyepoint::terrain {

/// Conservative: everything on the ellipsoid within the tile, at any height of its range, lies inside the box
/// and inside the cone.
struct TileBounds {
    Ecef centre{0.0};
    glm::dmat3 axes{1.0};    ///< columns: unit vectors east, north, up at the tile's middle
    glm::dvec3 half_m{0.0};  ///< half sides along the axes
    /// In the space where the ellipsoid is the unit sphere: unit direction of the middle, half angle around
    /// it, and the greatest distance from the centre.
    glm::dvec3 direction{0.0, 0.0, 1.0};
    double half_angle_rad = 0.0;
    double radius = 1.0;
};

/// height_min_m <= height_max_m: ellipsoidal heights of the tile's surface.
[[nodiscard]] TileBounds tile_bounds(TileId tile, double height_min_m, double height_max_m);

/// Least distance from a point to the box, metres; 0 inside.
[[nodiscard]] double distance_m(const TileBounds& bounds, const Ecef& point);

/// A plane through the eye: points p with dot(normal, p - eye) < 0 are outside. Unit normal.
/// True when the whole box is outside the plane.
[[nodiscard]] bool outside(const TileBounds& bounds, const Ecef& eye, const glm::dvec3& normal);

/// The Earth as something that hides what is behind it: an ellipsoid shrunk so far that no terrain is below
/// it.
class HorizonOccluder {
  public:
    /// lowest_height_m: lowest ellipsoidal height of any terrain.
    HorizonOccluder(const Ecef& eye, double lowest_height_m);
    /// True when no point of the tile can be seen over the curve of the Earth. Never true for an eye below
    /// the occluder.
    [[nodiscard]] bool hides(const TileBounds& bounds) const;
    /// The same of what reaches beyond the tile by so many metres at most, along the ground, and as high as a
    /// radius in the unit-sphere space (that of the tiles there).
    [[nodiscard]] bool hides(const TileBounds& bounds, double beyond_m, double radius) const;
    [[nodiscard]] bool hides(const Ecef& point) const;
    /// The same of what is in a ball, and nowhere higher than that.
    [[nodiscard]] bool hides(const Ecef& centre, double ball_m, double radius) const;

  private:
    [[nodiscard]] bool hides_cone(const glm::dvec3& direction, double half_angle_rad, double radius) const;

    glm::dvec3 eye_direction_;
    double occluder_radius_;  ///< in the unit-sphere space
    double eye_horizon_rad_;  ///< angle at the centre from the eye to its horizon; negative: eye is below
};

}  // namespace eyepoint::terrain
