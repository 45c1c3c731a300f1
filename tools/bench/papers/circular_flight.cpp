#include "tools/bench/papers/circular_flight.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <fmt/format.h>

#include "terrain/surface/surface_height.hpp"
#include "tools/bench/planar_path.hpp"

namespace eyepoint::tools {

namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kFramesPerSecond = 30.0;

struct Circle {
    double latitude_deg = 0.0, longitude_deg = 0.0;
    double radius_deg = 0.0;  ///< of latitude

    /// turn: clockwise from the west.
    [[nodiscard]] terrain::Geodetic at(double turn_rad, double height_m) const {
        return {latitude_deg + radius_deg * std::sin(turn_rad),
                longitude_deg - radius_deg * std::cos(turn_rad) / std::cos(latitude_deg * kPi / 180.0),
                terrain::EllipsoidalHeight{height_m}};
    }
};

}  // namespace

tl::expected<std::vector<ig::FlightEye>, std::string> eyes_of(
    const CircularFlight& flight, const std::shared_ptr<const terrain::Database>& database,
    ig::PictureSize size, double vertical_fov_deg) {
    const terrain::GeographicExtent& detail = database->manifest().detail_extent;
    const Circle circle{(detail.south_deg + detail.north_deg) / 2.0,
                        (detail.west_deg + detail.east_deg) / 2.0,
                        (detail.north_deg - detail.south_deg) * flight.radius_share};
    terrain::SurfaceHeight surface(database);
    double highest_m = -1e9;
    constexpr int kLooks = 360;
    for (int look = 0; look < kLooks; ++look) {
        const terrain::Geodetic place = circle.at(look * 2.0 * kPi / kLooks, 0.0);
        const auto ground = surface.at(place.latitude_deg, place.longitude_deg);
        if (!ground) {
            return tl::unexpected(fmt::format("{}: no ground can be read at {:.4f}, {:.4f}",
                                              database->folder().string(), place.latitude_deg,
                                              place.longitude_deg));
        }
        highest_m = std::max(highest_m, ground->metres());
    }
    std::vector<ig::FlightEye> eyes;
    for (std::size_t frame = 0; frame < flight.frames; ++frame) {
        const double turn_rad =
            2.0 * kPi * static_cast<double>(frame) / static_cast<double>(flight.circle_frames);
        eyes.push_back({static_cast<double>(frame) / kFramesPerSecond, static_cast<std::uint32_t>(frame),
                        eye_over(circle.at(turn_rad, highest_m + flight.above_m),
                                 {turn_rad, flight.pitch_deg * kPi / 180.0, 0.0}, size, vertical_fov_deg)});
    }
    return eyes;
}

}  // namespace eyepoint::tools
