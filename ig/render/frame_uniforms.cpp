#include "ig/render/frame_uniforms.hpp"

#include <algorithm>
#include <cmath>

#include "terrain/block/block.hpp"
#include "terrain/geodesy/earth.hpp"

namespace eyepoint::ig {

namespace {

/// Koschmieder: contrast falls to 2% at the visibility, so extinction is 3.912 over it (WMO-No. 8, 9.1.1).
constexpr double kKoschmieder = 3.912;
/// What clean air takes of it at 550 nm, 1/m; the rest is haze.
constexpr double kCleanAirExtinction = 13.5e-6;
constexpr double kLeastHazeExtinction = 2e-6;

glm::vec4 padded(const std::array<float, 3>& value) { return {value[0], value[1], value[2], 0.0F}; }
glm::vec4 padded(const glm::dvec3& value, double w = 0.0) { return glm::vec4{glm::dvec4{value, w}}; }

glm::dvec3 sun_direction(const glm::dmat3& enu, const SceneOptions& options) {
    constexpr double kRadians = 3.14159265358979323846 / 180.0;
    const double azimuth = options.sun_azimuth_deg * kRadians,
                 elevation = options.sun_elevation_deg * kRadians;
    return enu * glm::dvec3{std::sin(azimuth) * std::cos(elevation), std::cos(azimuth) * std::cos(elevation),
                            std::sin(elevation)};
}

}  // namespace

glm::dmat4 clip_from_relative(const View& view) {
    const double width = view.right - view.left, height = view.top - view.bottom;
    glm::dmat4 clip_from_view{0.0};
    clip_from_view[0][0] = 2.0 / width;
    clip_from_view[1][1] = 2.0 / height;
    clip_from_view[2][0] = (view.right + view.left) / width;
    clip_from_view[2][1] = (view.top + view.bottom) / height;
    clip_from_view[2][3] = -1.0;
    clip_from_view[3][2] = view.near_m;
    return clip_from_view * glm::dmat4{glm::transpose(view.axes)};
}

FrameUniforms frame_uniforms(const View& view, const SceneOptions& options) {
    const auto eye = terrain::split(view.eye_ecef);
    const terrain::Geodetic place = terrain::to_geodetic(view.eye_ecef);
    const glm::dmat3 enu = terrain::east_north_up(place.latitude_deg, place.longitude_deg);
    const double haze =
        std::max(kKoschmieder / options.visibility_m - kCleanAirExtinction, kLeastHazeExtinction);
    const glm::dvec3 corner = view.axes * glm::dvec3{view.left, view.bottom, -1.0};
    return {
        .clip_from_relative = glm::mat4{clip_from_relative(view)},
        .eye_high = padded(eye.high),
        .eye_low = padded(eye.low),
        .eye_up = padded(enu[2], place.height.metres()),
        .sun_direction = padded(sun_direction(enu, options), view.pixels_per_radian()),
        .mie = {static_cast<float>(haze), 0.0F, 0.0F, 0.0F},
        .ray_corner = padded(corner),
        .ray_right = padded(view.axes[0] * (view.right - view.left)),
        .ray_up = padded(view.axes[1] * (view.top - view.bottom)),
    };
}

}  // namespace eyepoint::ig
