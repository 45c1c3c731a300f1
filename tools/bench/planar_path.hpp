/// Flights over a planar benchmark field, laid onto the field's georeference.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "ig/recorded_flight.hpp"
#include "terrain/geodesy/earth.hpp"
#include "terrain/tiling/tile_id.hpp"

namespace eyepoint::tools {

/// A square field of posts: west and south posts on the extent's lines, `side_m` across in its planar frame.
struct PlanarField {
    terrain::GeographicExtent posts;
    double side_m = 0.0;
};

/// The benchmark field (Mt Rainier): 4097 posts 22.5 m apart; the outer posts of its georeference.
inline constexpr PlanarField kRainierField{{-121.9, 46.1, -120.7, 46.93}, 92160.0};

/// A level eye without an offset from the vehicle; nothing nearer than 10 m is drawn.
[[nodiscard]] ig::Eyepoint eye_over(const terrain::Geodetic& place, const terrain::Attitude& attitude,
                                    ig::PictureSize size, double vertical_fov_deg);

/// Reads a path of lines "east_m,north_m,height_m,heading_rad,pitch_rad" behind one line of headings: heading
/// clockwise from north, pitch nose up, height above the ellipsoid. East and north become longitude and
/// latitude linearly over the field. One eye a line, 30 a second. On failure: one sentence with file and
/// line.
[[nodiscard]] tl::expected<std::vector<ig::FlightEye>, std::string> read_planar_path(
    const std::filesystem::path& file, const PlanarField& field, ig::PictureSize size,
    double vertical_fov_deg);

}  // namespace eyepoint::tools
