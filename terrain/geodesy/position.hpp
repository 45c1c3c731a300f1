/// Positions on and above the Earth, each datum its own type.
#pragma once

#include <glm/vec3.hpp>

namespace eyepoint::terrain {

/// Height above the WGS84 ellipsoid, metres. What geometry is made of.
class EllipsoidalHeight {
  public:
    constexpr EllipsoidalHeight() = default;
    constexpr explicit EllipsoidalHeight(double metres) : metres_(metres) {}
    [[nodiscard]] constexpr double metres() const { return metres_; }
    auto operator<=>(const EllipsoidalHeight&) const = default;

  private:
    double metres_ = 0.0;
};

/// Height above mean sea level (orthometric, EGM96), metres. What people, charts and hosts speak of.
/// It becomes an EllipsoidalHeight only through a Geoid.
class MslHeight {
  public:
    constexpr MslHeight() = default;
    constexpr explicit MslHeight(double metres) : metres_(metres) {}
    [[nodiscard]] constexpr double metres() const { return metres_; }
    auto operator<=>(const MslHeight&) const = default;

  private:
    double metres_ = 0.0;
};

/// A place by geodetic coordinates. Latitude -90..90 degrees, north positive; longitude in degrees, east
/// positive, any turn.
struct Geodetic {
    double latitude_deg = 0.0;
    double longitude_deg = 0.0;
    EllipsoidalHeight height;
};

/// Earth-centred, earth-fixed Cartesian position, metres: x through 0 N 0 E, y through 0 N 90 E, z through
/// the north pole. Always double; only differences to the eye become float.
using Ecef = glm::dvec3;

}  // namespace eyepoint::terrain
