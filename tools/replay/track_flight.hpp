/// A track log as a flight: evenly spaced positions, attitudes and velocities.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "net/wire/fgnetfdm.hpp"
#include "tools/replay/track.hpp"

namespace eyepoint::tools {

struct FlightSampling {
    double rate_hz = 30.0;  ///< 0.1..1000
    double from_s = 0.0;    ///< after the first fix
    double until_s = std::numeric_limits<double>::infinity();
    double altitude_offset_m = 0.0;  ///< added to every altitude, so that it is above the datum wanted
};

struct FlightSample {
    double time_s = 0.0;  ///< after the first fix
    net::wire::FgNetFdm fdm;
};

/// Samples at from_s, from_s + 1 / rate_hz, ... up to until_s or the last fix. Attitudes are the log's own
/// where every fix has one, else those of coordinated_attitudes. Empty when nothing lies between from_s and
/// until_s.
[[nodiscard]] std::vector<FlightSample> sample_flight(const Track& track, const FlightSampling& sampling);

}  // namespace eyepoint::tools
