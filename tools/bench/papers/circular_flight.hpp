/// A flight in a circle around the middle of a database's detail.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "ig/picture.hpp"
#include "ig/recorded_flight.hpp"
#include "terrain/database/database.hpp"

namespace eyepoint::tools {

struct CircularFlight {
    std::size_t circle_frames = 2500;  ///< all the way round
    std::size_t frames = 120;          ///< flown of it, clockwise from the west
    double radius_share = 0.25;        ///< of the detail's side from south to north
    double above_m = 1000.0;           ///< the highest ground below the circle
    double pitch_deg = -10.0;
};

/// One eye a frame, looking along the path. On failure (no ground there): one sentence.
[[nodiscard]] tl::expected<std::vector<ig::FlightEye>, std::string> eyes_of(
    const CircularFlight& flight, const std::shared_ptr<const terrain::Database>& database,
    ig::PictureSize size, double vertical_fov_deg);

}  // namespace eyepoint::tools
