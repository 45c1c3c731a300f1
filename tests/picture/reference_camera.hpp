/// A camera on the WGS84 Earth in plain double precision: the expected side of the picture tests. It shares
/// no code with what it judges; GeographicLib places points, everything else is written out here.
#pragma once

#include <optional>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace eyepoint::testing {

/// Geodetic WGS84, degrees and metres above the ellipsoid.
struct Place {
    double latitude_deg = 0.0;
    double longitude_deg = 0.0;
    double height_m = 0.0;
};

[[nodiscard]] glm::dvec3 ecef_of(const Place& place);
/// Where one arrives after a distance along a geodesic; the height is kept.
[[nodiscard]] Place moved(const Place& from, double azimuth_deg, double distance_m);

/// Where an eye is, how it looks and what its picture covers. Yaw from true north clockwise, pitch nose up,
/// roll right wing down, applied in this order. Square pixels, the view axis through the picture's middle.
struct CameraPose {
    Place place;
    double yaw_deg = 0.0;
    double pitch_deg = 0.0;
    double roll_deg = 0.0;
    double vertical_fov_deg = 40.0;
    int width_px = 1920;
    int height_px = 1080;
};

/// The attitude (roll 0) that looks from a place at a point.
[[nodiscard]] CameraPose looking_at(const Place& eye, const glm::dvec3& target_ecef);

/// Picture coordinates: pixels from the upper left corner of the picture, x to the right, y down; the centre
/// of pixel (i, j) is (i + 0.5, j + 0.5).
class ReferenceCamera {
  public:
    explicit ReferenceCamera(const CameraPose& pose);

    [[nodiscard]] const glm::dvec3& eye() const { return eye_; }
    [[nodiscard]] double pixels_per_tangent() const { return kappa_px_; }

    /// Nothing for a point behind the eye.
    [[nodiscard]] std::optional<glm::dvec2> project(const glm::dvec3& ecef) const;
    /// From the eye through a place of the picture, ECEF; its component along the view axis is 1.
    [[nodiscard]] glm::dvec3 ray(const glm::dvec2& pixel) const;
    /// Direction in the picture, per unit of length in space, of a displacement of the ray's end in ECEF.
    [[nodiscard]] glm::dvec2 image_direction(const glm::dvec2& pixel, const glm::dvec3& displacement) const;

    /// Distance along the view axis to the ellipsoid whose semi-axes are WGS84's plus a height (at 0, the
    /// WGS84 ellipsoid itself); nothing where the ray misses it. The eye is outside.
    [[nodiscard]] std::optional<double> ellipsoid_distance_m(const glm::dvec2& pixel, double height_m) const;
    /// How deep the ray goes into that ellipsoid: positive where it hits, 0 on the horizon. Along a straight
    /// line in the picture it is a quadratic function of the place.
    [[nodiscard]] double ellipsoid_discriminant(const glm::dvec2& pixel, double height_m) const;

  private:
    glm::dvec3 eye_;
    glm::dvec3 forward_, right_, down_;
    glm::dvec2 centre_px_;
    double kappa_px_;
};

}  // namespace eyepoint::testing
