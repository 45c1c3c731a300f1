/// From what the host has said to the view that is drawn.
#pragma once

#include <optional>

#include "config/settings.hpp"
#include "ig/picture.hpp"
#include "ig/view.hpp"
#include "net/host_state.hpp"
#include "terrain/geodesy/geoid.hpp"
#include "terrain/geodesy/position.hpp"
#include "terrain/surface/surface_height.hpp"

namespace eyepoint::ig {

/// Widest half angle of a view volume, degrees; a host's larger one is drawn as this (at 90 its tangent is
/// infinite).
inline constexpr double kWidestHalfAngleDeg = 89.0;

/// The eye of one frame: the view to draw, and where that is.
struct Eyepoint {
    View view;
    terrain::Geodetic place;  ///< of the eye itself, its offset from the vehicle included
};

/// How a host's words are read.
struct EyepointReading {
    config::ViewSettings view;
    config::VerticalDatum altitude_datum = config::VerticalDatum::Msl;
    const terrain::Geoid* geoid = nullptr;  ///< not owned; needed where the datum is MSL
    /// Not owned; for entities that the host clamps to the ground. Without it, or where it cannot be read,
    /// their altitude is taken as it is.
    terrain::SurfaceHeight* surface = nullptr;
};

/// The eye that the host's newest state asks for, or nothing while it has not placed the vehicle.
///
/// The view stands on its entity (CIGI's view by number; otherwise the ownship, entity 0) and its axes are
///     body axes of the entity x the host's view attitude x the channel's own attitude (settings),
/// the eye at the entity's reference point plus the host's offset and the channel's own, both along the
/// entity's body axes. What the host has not said of the view volume comes from the settings' vertical field
/// of view and the picture's shape. All in double precision: the axes' error is under 1e-15, the eye's under
/// 10 nm beside the geoid's. Thread use: as that of the reading's surface.
[[nodiscard]] std::optional<Eyepoint> eyepoint_of(const net::HostState& state, const EyepointReading& reading,
                                                  PictureSize size);

/// The same with the view's entity elsewhere than the state has it: moved on in time.
[[nodiscard]] Eyepoint eyepoint_of(const net::HostState& state, const net::EntityState& entity,
                                   const EyepointReading& reading, PictureSize size);

/// The number of the entity that a view stands on.
[[nodiscard]] std::uint16_t viewed_entity(const net::HostState& state, std::uint16_t view);

/// A view from a place, level and looking north, with the settings' view volume: before a host has spoken.
[[nodiscard]] View neutral_view(const terrain::Geodetic& place, const config::ViewSettings& settings,
                                PictureSize size);

}  // namespace eyepoint::ig
