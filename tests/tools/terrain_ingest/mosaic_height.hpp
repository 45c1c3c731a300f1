/// A mosaic asked for one place.
#pragma once

#include <span>

#include "tools/terrain/mosaic.hpp"

namespace eyepoint::tools {

/// Metres above mean sea level.
[[nodiscard]] inline float msl_at(const Mosaic& mosaic, double latitude_deg, double longitude_deg) {
    const LatLon place = normalised(latitude_deg, longitude_deg);
    return mosaic.sample_msl(std::span{&place, 1}).front().msl_height_m;
}

}  // namespace eyepoint::tools
