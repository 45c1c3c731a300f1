/// The eyes that a bench flies: of a path over the benchmark field or of a recorded flight.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "ig/recorded_flight.hpp"

namespace eyepoint::tools {

struct EyesRequest {
    std::filesystem::path
        file;  ///< .csv: planar_path.hpp, over the benchmark field; else a recorded flight (pcap)
    ig::PictureSize size{800, 800};
    double vertical_fov_deg = 40.0;
    double rate_hz = 30.0;   ///< recorded flights
    bool ellipsoid = false;  ///< the recorded flight's altitudes are above the ellipsoid, not the sea
    double from_s = 0.0;     ///< the part of a recorded flight
    double until_s = 1e9;
};

/// On failure: one sentence.
[[nodiscard]] tl::expected<std::vector<ig::FlightEye>, std::string> read_eyes(const EyesRequest& request);

}  // namespace eyepoint::tools
