#include "tests/picture/spike_terrain.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include <glm/geometric.hpp>

#include "terrain/geodesy/geoid.hpp"
#include "tools/terrain/compile.hpp"

namespace eyepoint::testing {

namespace {

/// Fine enough that sides made of many posts are straight.
constexpr double kHeightStepM = 1.0 / 1024.0;
constexpr unsigned kPlanetDepth = 1;
constexpr double kPostsInside = 4.0;

double spacing_deg(unsigned depth) { return std::ldexp(180.0, -static_cast<int>(depth)) / 32.0; }

bool at_pole(const Spike& spike) { return std::abs(spike.apex.latitude_deg) == 90.0; }

double east_of_apex_deg(const Spike& spike, double longitude_deg) {
    return std::remainder(longitude_deg - spike.apex.longitude_deg, 360.0);
}

class SpikeSource final : public tools::ElevationSource {
  public:
    explicit SpikeSource(const Spike& spike) : spike_(spike), spacing_deg_(spacing_deg(spike.depth)) {}

    [[nodiscard]] bool has_detail(terrain::TileId tile) const override {
        if (tile.depth <= kPlanetDepth) return true;
        if (tile.depth > spike_.depth) return false;
        const terrain::GeographicExtent area = extent(tile);
        const double rows_deg = (spike_.half_height_rows + 0.5) * spacing_deg_;
        const double columns_deg = (spike_.half_width_columns + 0.5) * spacing_deg_;
        const double middle_deg = (area.west_deg + area.east_deg) / 2.0;
        const double half_deg = (area.east_deg - area.west_deg) / 2.0;
        return area.south_deg < spike_.apex.latitude_deg + rows_deg &&
               area.north_deg > spike_.apex.latitude_deg - rows_deg &&
               (at_pole(spike_) || std::abs(east_of_apex_deg(spike_, middle_deg)) < columns_deg + half_deg);
    }

    void sample(const tools::Lattice& lattice, std::span<tools::SurfaceSample> out) const override {
        for (int row = 0; row < lattice.rows; ++row) {
            for (int column = 0; column < lattice.columns; ++column) {
                out[static_cast<std::size_t>(row * lattice.columns + column)] = {
                    height_m(lattice.south_deg + row * lattice.step_deg,
                             lattice.west_deg + column * lattice.step_deg),
                    false};
            }
        }
    }

  private:
    [[nodiscard]] float height_m(double latitude_deg, double longitude_deg) const {
        const double rows = std::abs(latitude_deg - spike_.apex.latitude_deg) / spacing_deg_;
        const double columns =
            at_pole(spike_) ? 0.0 : std::abs(east_of_apex_deg(spike_, longitude_deg)) / spacing_deg_;
        const double share = 1.0 - rows / spike_.half_height_rows - columns / spike_.half_width_columns;
        return static_cast<float>(spike_.apex.height_m * std::max(share, 0.0));
    }

    Spike spike_;
    double spacing_deg_;
};

/// Points at height 0 that the straight sides run to from the apex; the outermost two, as seen from outside,
/// are the ends of the outline's sides.
std::vector<Place> base_points(const Spike& spike) {
    const double spacing = spacing_deg(spike.depth);
    const double latitude = spike.apex.latitude_deg, longitude = spike.apex.longitude_deg;
    std::vector<Place> points;
    if (at_pole(spike)) {
        const double ring = latitude - std::copysign(spacing, latitude);
        const auto around = static_cast<int>(std::lround(360.0 / spacing));
        for (int post = 0; post < around; ++post) points.push_back({ring, post * spacing, 0.0});
        return points;
    }
    const double half_width = spike.half_width_columns * spacing,
                 half_height = spike.half_height_rows * spacing;
    points = {{latitude, longitude - half_width, 0.0},
              {latitude, longitude + half_width, 0.0},
              {latitude - half_height, longitude, 0.0},
              {latitude + half_height, longitude, 0.0}};
    if (spike.half_height_rows == 1) {
        // Cells are split from south-west to north-east, so the apex has six neighbours, not eight.
        points.push_back({latitude - spacing, longitude - spacing, 0.0});
        points.push_back({latitude + spacing, longitude + spacing, 0.0});
    }
    return points;
}

}  // namespace

Place on_post(const Place& place, unsigned depth) {
    const double spacing = spacing_deg(depth);
    const auto nearest = [spacing](double from_edge_deg) {
        const double post = std::round(from_edge_deg / spacing);
        if (post * spacing == from_edge_deg) return from_edge_deg;
        const double tile = std::floor(post / 32.0) * 32.0;
        return std::clamp(post, tile + kPostsInside, tile + 32.0 - kPostsInside) * spacing;
    };
    return {nearest(place.latitude_deg + 90.0) - 90.0, nearest(place.longitude_deg + 180.0) - 180.0,
            place.height_m};
}

Outline outline(const Spike& spike, const ReferenceCamera& camera) {
    const glm::dvec2 apex = camera.project(ecef_of(spike.apex)).value();
    std::vector<glm::dvec2> sides;
    glm::dvec2 middle{0.0};
    for (const Place& place : base_points(spike)) {
        sides.push_back(camera.project(ecef_of(place)).value() - apex);
        middle += sides.back();
    }
    const auto bearing = [&](const glm::dvec2& side) {
        return std::atan2(middle.x * side.y - middle.y * side.x, glm::dot(middle, side));
    };
    const auto [least, most] = std::minmax_element(
        sides.begin(), sides.end(), [&](const auto& a, const auto& b) { return bearing(a) < bearing(b); });
    return {apex, apex + *least, apex + *most};
}

std::shared_ptr<const terrain::Database> make_spike_database(const Spike& spike,
                                                             const std::filesystem::path& folder) {
    const auto geoid = terrain::Geoid::load(terrain::Geoid::default_grid());
    if (!geoid) throw std::runtime_error(geoid.error());
    const SpikeSource source(spike);
    tools::CompileRequest request;
    request.elevation = &source;
    request.geoid = &*geoid;
    request.manifest.name = "spike";
    request.output = folder;
    request.height_step_m = kHeightStepM;
    if (const auto made = tools::compile_database(request); !made) throw std::runtime_error(made.error());
    auto database = terrain::Database::open(folder);
    if (!database) throw std::runtime_error(database.error());
    return std::make_shared<const terrain::Database>(std::move(*database));
}

}  // namespace eyepoint::testing
