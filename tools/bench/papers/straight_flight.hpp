/// A flight straight north over the middle of a database's detail, as a track log.
#pragma once

#include <memory>
#include <string>

#include <tl/expected.hpp>

#include "terrain/database/database.hpp"

namespace eyepoint::tools {

struct StraightFlight {
    double speed_m_s = 200.0;
    double seconds = 30.0;
    double above_m =
        1000.0;  ///< above the ground under the eye at the start, half-way and end, linear between
    double pitch_deg = -10.0;
};

/// In the form that eyepoint-replay converts (CSV), altitudes above the ellipsoid; the middle of the flight
/// is the middle of the detail. On failure (no ground there, detail too small): one sentence.
[[nodiscard]] tl::expected<std::string, std::string> track_of(
    const StraightFlight& flight, const std::shared_ptr<const terrain::Database>& database);

}  // namespace eyepoint::tools
