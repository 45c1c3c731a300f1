/// A smooth curve through the fixes of a track.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <GeographicLib/LocalCartesian.hpp>

#include "tools/replay/track.hpp"

namespace eyepoint::tools {

using Vector3 = std::array<double, 3>;

/// Cubic Hermite curve, continuous in position and velocity, in one Cartesian frame (east, north, up at the
/// track's middle fix, metres), so that poles and the antimeridian are places like any other. It passes
/// through every fix. Velocities at the fixes are those of the parabola through three neighbours (Catmull-Rom
/// for uneven times), held to twice the slower of the two legs' speeds: the curve does not swing out of a
/// halt or a gap. Altitudes are taken for ellipsoidal heights; what is put in comes out.
class TrackCurve {
  public:
    explicit TrackCurve(const Track& track);

    struct Point {
        Vector3 position_m;
        Vector3 velocity_mps;
    };
    /// Time as in the track; before the first and after the last fix it stands still there.
    [[nodiscard]] Point at(double time_s) const;

    /// A point of the curve's frame on the Earth.
    struct Place {
        double latitude_deg, longitude_deg, altitude_m;
        /// Columns: east, north and up at the place, in the curve's frame; row by row.
        std::array<double, 9> axes;
    };
    [[nodiscard]] Place place(const Vector3& position_m) const;

    [[nodiscard]] double first_s() const { return knots_.front().time_s; }
    [[nodiscard]] double last_s() const { return knots_.back().time_s; }

  private:
    struct Knot {
        double time_s;
        Vector3 position_m;
        Vector3 velocity_mps;
    };
    void set_velocities();

    GeographicLib::LocalCartesian frame_;
    std::vector<Knot> knots_;
};

}  // namespace eyepoint::tools
