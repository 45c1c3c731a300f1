/// A small planet with a formula for its surface: detailed around one place, coarse elsewhere.
#pragma once

#include <filesystem>
#include <memory>

#include "terrain/database/database.hpp"

namespace eyepoint::testing {

struct AnalyticTerrain {
    double latitude_deg = 46.5;  ///< middle of the detailed region
    double longitude_deg = 8.25;
    double half_size_deg = 0.6;  ///< of the region, in latitude and longitude
    unsigned detail_depth = 11;  ///< tiles of the region
    unsigned planet_depth = 2;   ///< tiles elsewhere
    double amplitude_m = 900.0;  ///< of the hills; 0: a bare ellipsoid, all sea
};

/// Ellipsoidal height of the surface, metres: smooth hills everywhere on the Earth, 0 where amplitude is 0.
/// One value at each pole.
[[nodiscard]] double analytic_height_m(const AnalyticTerrain& terrain, double latitude_deg,
                                       double longitude_deg);

/// Compiles it into a folder, which must not exist, and opens it. Throws std::runtime_error with the
/// sentence.
[[nodiscard]] std::shared_ptr<const terrain::Database> make_database(const AnalyticTerrain& terrain,
                                                                     const std::filesystem::path& folder);

/// A folder for one test, removed with what is in it.
class ScratchFolder {
  public:
    ScratchFolder();
    ~ScratchFolder();
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

/// A database of a terrain in a folder of its own. Dear to make: the tests of a file share one.
class AnalyticPlanet {
  public:
    explicit AnalyticPlanet(const AnalyticTerrain& terrain)
        : terrain_(terrain), database_(make_database(terrain, scratch_.path() / "db")) {}

    [[nodiscard]] const AnalyticTerrain& terrain() const { return terrain_; }
    [[nodiscard]] const std::shared_ptr<const terrain::Database>& database() const { return database_; }

  private:
    ScratchFolder scratch_;
    AnalyticTerrain terrain_;
    std::shared_ptr<const terrain::Database> database_;
};

}  // namespace eyepoint::testing
