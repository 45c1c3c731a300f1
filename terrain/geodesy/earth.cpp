#include "terrain/geodesy/earth.hpp"

#include <cmath>

#include <GeographicLib/Geocentric.hpp>
#include <GeographicLib/Math.hpp>

namespace eyepoint::terrain {

Ecef to_ecef(const Geodetic& place) {
    Ecef point;
    GeographicLib::Geocentric::WGS84().Forward(place.latitude_deg, place.longitude_deg, place.height.metres(),
                                               point.x, point.y, point.z);
    return point;
}

Geodetic to_geodetic(const Ecef& point) {
    double latitude_deg = 0.0;
    double longitude_deg = 0.0;
    double height_m = 0.0;
    GeographicLib::Geocentric::WGS84().Reverse(point.x, point.y, point.z, latitude_deg, longitude_deg,
                                               height_m);
    return {latitude_deg, longitude_deg, EllipsoidalHeight{height_m}};
}

// Written out, as GeographicLib gives its rotation on the heap alone, and every frame asks for one.
glm::dmat3 east_north_up(double latitude_deg, double longitude_deg) {
    double sin_latitude = 0.0, cos_latitude = 0.0, sin_longitude = 0.0, cos_longitude = 0.0;
    GeographicLib::Math::sincosd(latitude_deg, sin_latitude, cos_latitude);
    GeographicLib::Math::sincosd(longitude_deg, sin_longitude, cos_longitude);
    return {{-sin_longitude, cos_longitude, 0.0},
            {-cos_longitude * sin_latitude, -sin_longitude * sin_latitude, cos_latitude},
            {cos_longitude * cos_latitude, sin_longitude * cos_latitude, sin_latitude}};
}

glm::dmat3 attitude_rotation(const Attitude& attitude) {
    const double cy = std::cos(attitude.yaw_rad), sy = std::sin(attitude.yaw_rad);
    const double cp = std::cos(attitude.pitch_rad), sp = std::sin(attitude.pitch_rad);
    const double cr = std::cos(attitude.roll_rad), sr = std::sin(attitude.roll_rad);
    const glm::dmat3 yaw{{cy, sy, 0.0}, {-sy, cy, 0.0}, {0.0, 0.0, 1.0}};
    const glm::dmat3 pitch{{cp, 0.0, -sp}, {0.0, 1.0, 0.0}, {sp, 0.0, cp}};
    const glm::dmat3 roll{{1.0, 0.0, 0.0}, {0.0, cr, sr}, {0.0, -sr, cr}};
    return yaw * pitch * roll;
}

glm::dmat3 body_axes(double latitude_deg, double longitude_deg, const Attitude& attitude) {
    const glm::dmat3 enu = east_north_up(latitude_deg, longitude_deg);
    const glm::dmat3 ned{enu[1], enu[0], -enu[2]};
    return ned * attitude_rotation(attitude);
}

}  // namespace eyepoint::terrain
