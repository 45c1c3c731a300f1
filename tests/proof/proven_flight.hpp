/// A level-of-detail method flown over a database, and what is wrong with what it draws.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "ig/recorded_flight.hpp"
#include "tools/bench/measure/flight_measure.hpp"

namespace eyepoint::testing {

/// A tolerance, and its slack as a share of it.
struct Tolerance {
    double tau_px = 1.0;
    double slack_share = 0.0;
};
/// Every tolerance with every slack that the claims are made for.
inline constexpr std::array<Tolerance, 12> kTolerances{{{0.5, 0.0},
                                                        {0.5, 0.1},
                                                        {0.5, 0.2},
                                                        {1.0, 0.0},
                                                        {1.0, 0.1},
                                                        {1.0, 0.2},
                                                        {2.0, 0.0},
                                                        {2.0, 0.1},
                                                        {2.0, 0.2},
                                                        {4.0, 0.0},
                                                        {4.0, 0.1},
                                                        {4.0, 0.2}}};

/// EYEPOINT_EVERY_FRAME is set: nothing is left out.
[[nodiscard]] bool every_frame();
/// So many, or 1 where every frame is looked at.
[[nodiscard]] std::size_t one_in(std::size_t frames);

[[nodiscard]] std::vector<terrain::LodView> views_of(std::span<const ig::FlightEye> eyes,
                                                     const Tolerance& tolerance);

/// The post that is farthest beyond the tolerance.
struct Violation {
    std::size_t frame = 0;
    terrain::TileId tile;
    int row = 0, column = 0;
    double error_px = 0.0, allowed_px = 0.0, above_m = 0.0;
    bool folded = false;
};

struct Findings {
    tools::FlightFigures figures;
    std::uint64_t beyond = 0;        ///< posts in view beyond tau + s and what rounding allows
    std::uint64_t rounded_over = 0;  ///< posts beyond tau + s by no more than that
    Violation worst;                 ///< where beyond > 0
};

/// Thread use: one thread.
class ProvenFlight {
  public:
    /// Throws std::runtime_error.
    explicit ProvenFlight(std::shared_ptr<const terrain::Database> database,
                          const tools::FlightOptions& options = {});

    /// Flies all views, with everything loaded, and looks at one in `every`. Throws std::runtime_error.
    [[nodiscard]] Findings fly(std::span<const terrain::LodView> views, const tools::MeasureOptions& options);

  private:
    std::shared_ptr<const terrain::Database> database_;
    std::unique_ptr<tools::LodFlight> flight_;
    tools::FullSurface surface_;
};

/// The mesh is whole and covers every post in view. Prints the figures, with the worst post beyond tau + s.
void expect_whole(const Findings& findings, const std::string& name);
/// And no post is beyond tau + s.
void expect_sound(const Findings& findings, const std::string& name);

/// Flies the views while at most `blocks_a_frame` blocks arrive between two frames, and expects every frame's
/// mesh to be whole, and every `every`-th one's to cover every post in view. Returns the number of frames in
/// which something was missing.
std::size_t expect_whole_while_loading(const std::shared_ptr<const terrain::Database>& database,
                                       std::span<const terrain::LodView> views, std::size_t blocks_a_frame,
                                       std::size_t every, const std::string& lod_method = "nested");

}  // namespace eyepoint::testing
