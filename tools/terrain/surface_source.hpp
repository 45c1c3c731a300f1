/// What the compiler builds a database from: functions of place, whatever lies behind them (files, a
/// formula).
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "terrain/database/database.hpp"
#include "terrain/tiling/tile_id.hpp"

namespace eyepoint::tools {

/// A regular lattice of places: latitude south_deg + row * step_deg, longitude west_deg + column * step_deg.
/// Latitudes past a pole and longitudes past the antimeridian are to be taken as the places they mean.
struct Lattice {
    double south_deg = 0.0;
    double west_deg = 0.0;
    double step_deg = 0.0;
    int rows = 0;
    int columns = 0;
};

/// The surface at one place.
struct SurfaceSample {
    float ellipsoidal_height_m = 0.0F;
    bool water = false;
};

/// The Earth's surface as the compiler sees it: defined everywhere, the same answer for the same place.
/// Thread use: const use is safe from any thread.
class ElevationSource {
  public:
    virtual ~ElevationSource() = default;
    /// Whether the source has detail inside the tile that a tile one less deep would miss: then the tile is
    /// made.
    [[nodiscard]] virtual bool has_detail(terrain::TileId tile) const = 0;
    /// Samples in row order from the south-west; out.size() == rows * columns.
    virtual void sample(const Lattice& lattice, std::span<SurfaceSample> out) const = 0;
};

/// Colour of the Earth from above, where there is any.
/// Thread use: const use is safe from any thread.
class ImagerySource {
  public:
    virtual ~ImagerySource() = default;
    [[nodiscard]] virtual bool has_detail(terrain::TileId tile) const = 0;
    /// RGB triples in row order from the south-west; out.size() == rows * columns * 3.
    virtual void sample(const Lattice& lattice, std::span<std::uint8_t> out) const = 0;
};

}  // namespace eyepoint::tools
