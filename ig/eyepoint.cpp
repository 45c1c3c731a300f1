#include "ig/eyepoint.hpp"

#include <algorithm>
#include <cmath>

#include <glm/trigonometric.hpp>

#include "ig/motion/dead_reckoning.hpp"
#include "terrain/geodesy/earth.hpp"

namespace eyepoint::ig {

namespace {

/// Body axes (forward, right, down) to view axes (right, up, backward); both in the frame of `body`.
glm::dmat3 view_axes(const glm::dmat3& body) { return {body[1], -body[2], -body[0]}; }

terrain::Geodetic place_of(const net::EntityState& entity, const EyepointReading& reading) {
    if (entity.above_ground && reading.surface != nullptr) {
        if (const auto ground = reading.surface->at(entity.latitude_deg, entity.longitude_deg)) {
            return {entity.latitude_deg, entity.longitude_deg,
                    terrain::EllipsoidalHeight{ground->metres() + entity.altitude_m}};
        }
    }
    const bool is_msl = reading.altitude_datum == config::VerticalDatum::Msl;
    const terrain::EllipsoidalHeight height =
        is_msl ? reading.geoid->to_ellipsoidal(entity.latitude_deg, entity.longitude_deg,
                                               terrain::MslHeight{entity.altitude_m})
               : terrain::EllipsoidalHeight{entity.altitude_m};
    return {entity.latitude_deg, entity.longitude_deg, height};
}

double tangent_deg(double half_angle_deg) {
    return std::tan(glm::radians(std::clamp(half_angle_deg, -kWidestHalfAngleDeg, kWidestHalfAngleDeg)));
}

/// Size, nearest distance and view volume from the settings alone: symmetric, with square pixels.
View settings_view(const config::ViewSettings& settings, PictureSize size) {
    View view;
    view.width_px = size.width_px;
    view.height_px = size.height_px;
    view.near_m = settings.near_m;
    view.top = tangent_deg(settings.vertical_fov_deg / 2.0);
    view.bottom = -view.top;
    view.right = view.top * size.width_px / size.height_px;
    view.left = -view.right;
    return view;
}

void narrow_to_host(View& view, const net::ViewState& host) {
    if (host.left_deg) view.left = tangent_deg(*host.left_deg);
    if (host.right_deg) view.right = tangent_deg(*host.right_deg);
    if (host.bottom_deg) view.bottom = tangent_deg(*host.bottom_deg);
    if (host.top_deg) view.top = tangent_deg(*host.top_deg);
    if (host.near_m && *host.near_m > 0.0) view.near_m = *host.near_m;
}

net::ViewState host_view_of(const net::HostState& state, std::uint16_t view) {
    const auto found = state.views.find(view);
    return found == state.views.end() ? net::ViewState{} : found->second;
}

}  // namespace

std::uint16_t viewed_entity(const net::HostState& state, std::uint16_t view) {
    return host_view_of(state, view).entity_id;
}

std::optional<Eyepoint> eyepoint_of(const net::HostState& state, const EyepointReading& reading,
                                    PictureSize size) {
    const auto entity = state.entities.find(viewed_entity(state, reading.view.cigi_view));
    if (entity == state.entities.end()) return std::nullopt;
    return eyepoint_of(state, entity->second, reading, size);
}

Eyepoint eyepoint_of(const net::HostState& state, const net::EntityState& entity,
                     const EyepointReading& reading, PictureSize size) {
    const net::ViewState host_view = host_view_of(state, reading.view.cigi_view);
    const config::ViewSettings& channel = reading.view;
    const glm::dmat3 body =
        terrain::body_axes(entity.latitude_deg, entity.longitude_deg, attitude_of(entity.attitude));
    const glm::dmat3 turned =
        terrain::attitude_rotation(attitude_of(host_view.attitude)) *
        terrain::attitude_rotation(attitude_of({channel.yaw_deg, channel.pitch_deg, channel.roll_deg}));
    const glm::dvec3 offset_m{host_view.offset_m[0] + channel.eye_forward_m,
                              host_view.offset_m[1] + channel.eye_right_m,
                              host_view.offset_m[2] + channel.eye_down_m};

    Eyepoint eyepoint{.view = settings_view(channel, size), .place = {}};
    narrow_to_host(eyepoint.view, host_view);
    eyepoint.view.eye_ecef = terrain::to_ecef(place_of(entity, reading)) + body * offset_m;
    eyepoint.view.axes = view_axes(body * turned);
    eyepoint.place = terrain::to_geodetic(eyepoint.view.eye_ecef);
    return eyepoint;
}

View neutral_view(const terrain::Geodetic& place, const config::ViewSettings& settings, PictureSize size) {
    View view = settings_view(settings, size);
    view.eye_ecef = terrain::to_ecef(place);
    view.axes = view_axes(terrain::body_axes(place.latitude_deg, place.longitude_deg, {}));
    return view;
}

}  // namespace eyepoint::ig
