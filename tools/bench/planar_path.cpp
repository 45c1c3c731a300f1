#include "tools/bench/planar_path.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>

#include <fmt/format.h>

namespace eyepoint::tools {

namespace {

constexpr double kFramesPerSecond = 30.0;

struct PathPoint {
    double east_m = 0.0, north_m = 0.0, height_m = 0.0, heading_rad = 0.0, pitch_rad = 0.0;
};

ig::Eyepoint eye_at(const PathPoint& point, const PlanarField& field, ig::PictureSize size,
                    double vertical_fov_deg) {
    const terrain::GeographicExtent& posts = field.posts;
    const terrain::Geodetic place{
        posts.south_deg + (posts.north_deg - posts.south_deg) * point.north_m / field.side_m,
        posts.west_deg + (posts.east_deg - posts.west_deg) * point.east_m / field.side_m,
        terrain::EllipsoidalHeight{point.height_m}};
    return eye_over(place, {point.heading_rad, point.pitch_rad, 0.0}, size, vertical_fov_deg);
}

}  // namespace

ig::Eyepoint eye_over(const terrain::Geodetic& place, const terrain::Attitude& attitude, ig::PictureSize size,
                      double vertical_fov_deg) {
    const glm::dmat3 body = terrain::body_axes(place.latitude_deg, place.longitude_deg, attitude);
    const double top = std::tan(vertical_fov_deg * 3.14159265358979323846 / 360.0);
    const double right = top * size.width_px / size.height_px;
    return {{.eye_ecef = terrain::to_ecef(place),
             .axes = {body[1], -body[2], -body[0]},
             .left = -right,
             .right = right,
             .bottom = -top,
             .top = top,
             .width_px = size.width_px,
             .height_px = size.height_px,
             .near_m = 10.0},
            place};
}

tl::expected<std::vector<ig::FlightEye>, std::string> read_planar_path(const std::filesystem::path& file,
                                                                       const PlanarField& field,
                                                                       ig::PictureSize size,
                                                                       double vertical_fov_deg) {
    std::ifstream stream(file);
    if (!stream) return tl::unexpected(file.string() + ": cannot be read");
    std::vector<ig::FlightEye> eyes;
    std::string line;
    std::getline(stream, line);
    for (std::uint32_t number = 2; std::getline(stream, line); ++number) {
        PathPoint point;
        if (std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf,%lf", &point.east_m, &point.north_m, &point.height_m,
                        &point.heading_rad, &point.pitch_rad) != 5) {
            return tl::unexpected(
                fmt::format("{}:{}: five numbers are expected: east, north, height, heading, pitch",
                            file.string(), number));
        }
        const auto frame = static_cast<std::uint32_t>(eyes.size());
        eyes.push_back({frame / kFramesPerSecond, frame, eye_at(point, field, size, vertical_fov_deg)});
    }
    if (eyes.empty()) return tl::unexpected(file.string() + ": holds no eye");
    return eyes;
}

}  // namespace eyepoint::tools
