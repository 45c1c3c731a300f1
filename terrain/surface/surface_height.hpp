/// Height of the ground at a place, from the finest data there is, whatever is on the screen.
#pragma once

#include <memory>
#include <optional>

#include "terrain/database/database.hpp"
#include "terrain/geodesy/position.hpp"

namespace eyepoint::terrain {

/// Reads the deepest stored tile at the place, and keeps the last one: asking again nearby costs no read.
/// Thread use: one thread at a time.
class SurfaceHeight {
  public:
    explicit SurfaceHeight(std::shared_ptr<const Database> database) : database_(std::move(database)) {}

    /// Ellipsoidal height of the full-resolution surface: heights linear over the tile's triangles (every
    /// cell split from its south-west to its north-east post). Nothing when the tile cannot be read. Latitude
    /// -90..90, longitude any turn.
    [[nodiscard]] std::optional<EllipsoidalHeight> at(double latitude_deg, double longitude_deg);

  private:
    std::shared_ptr<const Database> database_;
    std::optional<BlockData> last_;
};

}  // namespace eyepoint::terrain
