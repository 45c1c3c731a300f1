#include "tools/bench/papers/straight_flight.hpp"

#include <fmt/format.h>

#include "terrain/surface/surface_height.hpp"

namespace eyepoint::tools {

namespace {
/// Of a degree of latitude, to a percent anywhere.
constexpr double kMetresPerDegree = 111200.0;
}  // namespace

tl::expected<std::string, std::string> track_of(const StraightFlight& flight,
                                                const std::shared_ptr<const terrain::Database>& database) {
    const terrain::GeographicExtent& detail = database->manifest().detail_extent;
    const double length_deg = flight.speed_m_s * flight.seconds / kMetresPerDegree;
    if (length_deg > detail.north_deg - detail.south_deg) {
        return tl::unexpected(fmt::format("{}: its detail is too small for {:.0f} s at {:.0f} m/s",
                                          database->folder().string(), flight.seconds, flight.speed_m_s));
    }
    const double longitude_deg = (detail.west_deg + detail.east_deg) / 2.0,
                 south_deg = (detail.south_deg + detail.north_deg - length_deg) / 2.0;
    terrain::SurfaceHeight surface(database);
    std::string track = "time_s,latitude_deg,longitude_deg,altitude_m,yaw_deg,pitch_deg,roll_deg\n";
    for (const double share : {0.0, 0.5, 1.0}) {
        const double latitude_deg = south_deg + share * length_deg;
        const auto ground = surface.at(latitude_deg, longitude_deg);
        if (!ground) {
            return tl::unexpected(fmt::format("{}: no ground can be read at {:.4f}, {:.4f}",
                                              database->folder().string(), latitude_deg, longitude_deg));
        }
        track += fmt::format("{},{:.8f},{:.8f},{:.2f},0,{},0\n", share * flight.seconds, latitude_deg,
                             longitude_deg, ground->metres() + flight.above_m, flight.pitch_deg);
    }
    return track;
}

}  // namespace eyepoint::tools
