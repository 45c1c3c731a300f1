#include "tests/support/analytic_terrain.hpp"

#include <array>
#include <cmath>
#include <stdexcept>

#include <stdlib.h>

#include "terrain/geodesy/geoid.hpp"
#include "tools/terrain/compile.hpp"

namespace eyepoint::testing {

namespace {

constexpr double kRadians = 3.14159265358979323846 / 180.0;

class AnalyticSource final : public tools::ElevationSource {
  public:
    explicit AnalyticSource(const AnalyticTerrain& terrain) : terrain_(terrain) {}

    [[nodiscard]] bool has_detail(terrain::TileId tile) const override {
        if (tile.depth <= terrain_.planet_depth) return true;
        if (tile.depth > terrain_.detail_depth) return false;
        const terrain::GeographicExtent area = extent(tile);
        const double half = terrain_.half_size_deg;
        const double middle_deg = (area.west_deg + area.east_deg) / 2.0;
        const double apart_deg = std::abs(std::remainder(middle_deg - terrain_.longitude_deg, 360.0));
        return area.south_deg < terrain_.latitude_deg + half &&
               area.north_deg > terrain_.latitude_deg - half &&
               apart_deg < half + (area.east_deg - area.west_deg) / 2.0;
    }

    void sample(const tools::Lattice& lattice, std::span<tools::SurfaceSample> out) const override {
        for (int row = 0; row < lattice.rows; ++row) {
            for (int column = 0; column < lattice.columns; ++column) {
                const double height_m =
                    analytic_height_m(terrain_, lattice.south_deg + row * lattice.step_deg,
                                      lattice.west_deg + column * lattice.step_deg);
                out[static_cast<std::size_t>(row * lattice.columns + column)] = {static_cast<float>(height_m),
                                                                                 terrain_.amplitude_m == 0.0};
            }
        }
    }

  private:
    AnalyticTerrain terrain_;
};

}  // namespace

double analytic_height_m(const AnalyticTerrain& terrain, double latitude_deg, double longitude_deg) {
    if (std::abs(latitude_deg) > 90.0) {
        latitude_deg = std::copysign(180.0 - std::abs(latitude_deg), latitude_deg);
        longitude_deg += 180.0;
    }
    // Waves in space, not in longitude: the same on both sides of the antimeridian and single-valued at the
    // poles.
    const double x = std::cos(latitude_deg * kRadians) * std::cos(longitude_deg * kRadians);
    const double y = std::cos(latitude_deg * kRadians) * std::sin(longitude_deg * kRadians);
    const double z = std::sin(latitude_deg * kRadians);
    double sum = 0.0;
    constexpr std::array<double, 4> kCyclesPerRadian{60.0, 450.0, 1900.0, 7300.0};
    constexpr std::array<double, 4> kShares{1.0, 0.6, 0.25, 0.08};
    for (std::size_t i = 0; i < kShares.size(); ++i) {
        const double k = kCyclesPerRadian[i];
        sum += kShares[i] * std::sin(k * x + 1.3 * k * z) * std::cos(k * y - 0.7 * k * z);
    }
    return terrain.amplitude_m * (1.0 + 0.5 * sum);
}

std::shared_ptr<const terrain::Database> make_database(const AnalyticTerrain& terrain,
                                                       const std::filesystem::path& folder) {
    const auto geoid = terrain::Geoid::load(terrain::Geoid::default_grid());
    if (!geoid) throw std::runtime_error(geoid.error());
    const AnalyticSource source(terrain);
    tools::CompileRequest request;
    request.elevation = &source;
    request.geoid = &*geoid;
    request.manifest.name = "analytic";
    request.output = folder;
    if (const auto made = tools::compile_database(request); !made) throw std::runtime_error(made.error());
    auto database = terrain::Database::open(folder);
    if (!database) throw std::runtime_error(database.error());
    return std::make_shared<const terrain::Database>(std::move(*database));
}

ScratchFolder::ScratchFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "eyepoint-test-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr)
        throw std::runtime_error("no scratch folder can be made as " + name);
    path_ = name;
}

ScratchFolder::~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

}  // namespace eyepoint::testing
