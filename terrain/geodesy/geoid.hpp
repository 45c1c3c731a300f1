/// Mean sea level: the EGM96 geoid between MSL and ellipsoidal heights.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include <tl/expected.hpp>

#include "terrain/geodesy/position.hpp"

namespace GeographicLib {
class Geoid;
}

namespace eyepoint::terrain {

/// The EGM96 geoid, cubic interpolation of a GeographicLib grid held in memory (15-minute grid: about 2 MB;
/// error against the full model at most 0.169 m, rms 7 mm, by GeographicLib's documentation). Thread use:
/// const use is safe from any thread (the grid is loaded whole).
class Geoid {
  public:
    /// Loads a grid in GeographicLib's PGM form. On failure: one sentence naming the file and the remedy.
    [[nodiscard]] static tl::expected<Geoid, std::string> load(const std::filesystem::path& pgm_file);

    /// The grid that was built or installed with Eyepoint: beside the installed program
    /// (../share/eyepoint/egm96-15.pgm), else in the build folder it was compiled in.
    [[nodiscard]] static std::filesystem::path default_grid();

    ~Geoid();
    Geoid(Geoid&&) noexcept;
    Geoid& operator=(Geoid&&) noexcept;

    /// Height of the geoid above the ellipsoid, metres, -107..86.
    [[nodiscard]] double undulation_m(double latitude_deg, double longitude_deg) const;

    [[nodiscard]] EllipsoidalHeight to_ellipsoidal(double latitude_deg, double longitude_deg,
                                                   MslHeight height) const;
    [[nodiscard]] MslHeight to_msl(double latitude_deg, double longitude_deg, EllipsoidalHeight height) const;

  private:
    explicit Geoid(std::unique_ptr<GeographicLib::Geoid> grid);
    std::unique_ptr<GeographicLib::Geoid> grid_;
};

}  // namespace eyepoint::terrain
