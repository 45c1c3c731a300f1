/// A hilly place of a few thousand posts, flown over with a mesh that can be tampered with.
#pragma once

#include <memory>

#include "tests/support/analytic_terrain.hpp"
#include "tools/bench/measure/flight.hpp"
#include "tools/bench/measure/post_error.hpp"

namespace eyepoint::testing {

/// A view volume of 60 by 45 degrees, 640 x 480 pixels, looking north and down from above a place.
terrain::LodView look_north(double latitude_deg, double longitude_deg, double height_m, double down_deg,
                            double tau_px);

/// A database with detail around a place, and the method `tile` on it.
class SmallFlight {
  public:
    explicit SmallFlight(std::shared_ptr<const terrain::Database> database);

    /// What is drawn for a view when everything is loaded.
    [[nodiscard]] tools::DrawnMesh mesh(const terrain::LodView& view);
    [[nodiscard]] tools::MeasuredPosts measure(const tools::DrawnMesh& mesh, const terrain::LodView& view);
    [[nodiscard]] tools::PostFigures figures(const tools::DrawnMesh& mesh, const terrain::LodView& view) {
        return post_figures(measure(mesh, view));
    }

  private:
    std::shared_ptr<const terrain::Database> database_;
    std::unique_ptr<tools::LodFlight> flight_;
    tools::FullSurface surface_;
};

/// Hills around 46.5 N 8.25 E, made once in a process.
inline constexpr AnalyticTerrain kSmallHills{.half_size_deg = 0.2, .detail_depth = 10};
[[nodiscard]] std::shared_ptr<const terrain::Database> small_hills();

/// A vertex of the mesh that is in view, at a post of full resolution, and not on a tile's edge.
[[nodiscard]] std::size_t vertex_in_sight(const tools::DrawnMesh& mesh, const terrain::LodView& view);

}  // namespace eyepoint::testing
