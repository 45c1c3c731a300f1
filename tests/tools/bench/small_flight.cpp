#include "tests/tools/bench/small_flight.hpp"

#include <cmath>
#include <stdexcept>

#include <glm/geometric.hpp>

#include "terrain/geodesy/earth.hpp"

namespace eyepoint::testing {

namespace {
constexpr double kRadians = 3.14159265358979323846 / 180.0;
}

terrain::LodView look_north(double latitude_deg, double longitude_deg, double height_m, double down_deg,
                            double tau_px) {
    const glm::dmat3 enu = terrain::east_north_up(latitude_deg, longitude_deg);
    const glm::dvec3 forward =
        enu[1] * std::cos(down_deg * kRadians) - enu[2] * std::sin(down_deg * kRadians);
    const glm::dvec3 right = enu[0], up = glm::cross(right, forward);
    const double half_width = std::tan(30.0 * kRadians), half_height = half_width * 480.0 / 640.0;
    return {
        .eye = terrain::to_ecef({latitude_deg, longitude_deg, terrain::EllipsoidalHeight{height_m}}),
        .sides = {glm::normalize(right + forward * half_width), glm::normalize(-right + forward * half_width),
                  glm::normalize(up + forward * half_height), glm::normalize(-up + forward * half_height)},
        .kappa_px = 480.0 / (2.0 * half_height),
        .tau_px = tau_px,
        .near_m = 1.0};
}

std::shared_ptr<const terrain::Database> small_hills() {
    static const AnalyticPlanet hills{kSmallHills};
    return hills.database();
}

SmallFlight::SmallFlight(std::shared_ptr<const terrain::Database> database)
    : database_(std::move(database)), surface_(database_) {
    auto flight = tools::LodFlight::create(database_, {.lod_method = "tile"});
    if (!flight) throw std::runtime_error(flight.error());
    flight_ = std::move(*flight);
}

tools::DrawnMesh SmallFlight::mesh(const terrain::LodView& view) {
    return tools::drawn_mesh(flight_->settle(view), flight_->method(), view);
}

tools::MeasuredPosts SmallFlight::measure(const tools::DrawnMesh& mesh, const terrain::LodView& view) {
    auto measured = measure_posts(surface_, mesh, {view, 40000.0});
    if (!measured) throw std::runtime_error(measured.error());
    return std::move(*measured);
}

std::size_t vertex_in_sight(const tools::DrawnMesh& mesh, const terrain::LodView& view) {
    // A full post of the detailed tiles is an even post of whatever is drawn below them: one without
    // neighbours on an edge.
    for (const tools::MeshPart& part : mesh.parts) {
        for (std::size_t i = part.first_triangle; i < part.end_triangle; ++i) {
            const std::size_t index = mesh.triangles[i].vertices[0];
            const tools::MeshVertex& vertex = mesh.vertices[index];
            const glm::dvec3 away{vertex.from_eye};
            bool seen = part.tile.depth == kSmallHills.detail_depth;
            for (const glm::dvec3& side : view.sides)
                seen = seen && glm::dot(side, away) > 0.1 * glm::length(away);
            seen = seen && vertex.tile_edges == 0;
            if (seen) return index;
        }
    }
    throw std::runtime_error("no vertex is in sight");
}

}  // namespace eyepoint::testing
