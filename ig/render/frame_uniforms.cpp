#include "ig/render/frame_uniforms.hpp"

#include <algorithm>
#include <cmath>

#include <glm/exponential.hpp>

#include "terrain/block/block.hpp"
#include "terrain/geodesy/earth.hpp"
#include "terrain/lod/error_level.hpp"

namespace eyepoint::ig {

namespace {

namespace shader {
using std::abs;
using std::exp;
using std::max;
using std::sqrt;
#include "ig/render/shaders/chapman.glsl"
}  // namespace shader

constexpr double kEarthRadiusM = 6371000.0;
constexpr double kAirScaleHeightM = 8000.0;
constexpr double kHazeScaleHeightM = 1200.0;
/// Rayleigh scattering at sea level, 1/m, at 680, 550 and 440 nm.
constexpr glm::dvec3 kRayleigh{5.8e-6, 13.5e-6, 33.1e-6};
constexpr glm::dvec3 kSunAboveTheAir{3.1415927, 3.0473449, 2.8902653};
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

/// Way through the air towards the sun, in metres at sea-level density.
double path_to_sun(double height_m, double cosine, double scale_height_m) {
    const auto in_scale_heights = [&](double metres) { return static_cast<float>(metres / scale_height_m); };
    return scale_height_m *
           static_cast<double>(shader::chapman(in_scale_heights(kEarthRadiusM), in_scale_heights(height_m),
                                               static_cast<float>(cosine)));
}

/// Sunlight after a share of the way through the air above the eye, fading as the sun sets.
glm::dvec3 sunlight(double height_m, double sun_cosine, double haze, double share) {
    const double cosine = std::max(sun_cosine, -0.05);
    // Haze scatters mostly forward: little of it is lost.
    const glm::dvec3 depth = kRayleigh * path_to_sun(height_m, cosine, kAirScaleHeightM) +
                             0.25 * haze * path_to_sun(height_m, cosine, kHazeScaleHeightM);
    const double risen = std::clamp((sun_cosine + 0.10) / 0.12, 0.0, 1.0);
    return kSunAboveTheAir * glm::exp(-share * depth) * risen * risen * (3.0 - 2.0 * risen);
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
    const glm::dvec3 to_sun = sun_direction(enu, options);
    const double height_m = std::max(place.height.metres(), 0.0), sun_cosine = glm::dot(to_sun, enu[2]);
    constexpr double kShareBeforeScattering = 0.4;
    const double level_scale =
        terrain::level_scale(options.tau_px + options.slack * options.tau_px, view.pixels_per_radian());
    const glm::dvec3 corner = view.axes * glm::dvec3{view.left, view.bottom, -1.0};
    return {
        .clip_from_relative = glm::mat4{clip_from_relative(view)},
        .eye_high = padded(eye.high),
        .eye_low = padded(eye.low),
        .eye_up = padded(enu[2], height_m),
        .sun_direction = padded(to_sun, view.pixels_per_radian()),
        .sunlight = padded(sunlight(height_m, sun_cosine, haze, 1.0), haze),
        .skylight = padded(sunlight(height_m, sun_cosine, haze, kShareBeforeScattering)),
        .air_at_eye = padded(
            glm::dvec3{std::exp(-height_m / kAirScaleHeightM), std::exp(-height_m / kHazeScaleHeightM), 0.0}),
        .ray_corner = padded(corner, view.near_m),
        .ray_right = padded(view.axes[0] * (view.right - view.left)),
        .ray_up = padded(view.axes[1] * (view.top - view.bottom)),
        .motion = padded(glm::dvec3{level_scale * level_scale, options.morph ? 1.0 : 0.0, 0.0}),
    };
}

}  // namespace eyepoint::ig
