/// What a level-of-detail method must reach on the benchmark field, measured without drawing.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "terrain/database/database.hpp"
#include "tools/bench/goals/goal_line.hpp"
#include "tools/bench/measure/flight_measure.hpp"

namespace eyepoint::tools {

/// The views of the benchmark's two paths; their tolerances are set by the goals.
struct GoalPaths {
    std::vector<terrain::LodView> cruise;
    std::vector<terrain::LodView> sweep;
    std::vector<terrain::LodView> low_cruise;  ///< cruise 700 m lower: 300 m above smoothed ground
};

struct GoalFigures {
    std::vector<GoalLine> lines;
    std::vector<std::string> notes;
};

class LodGoals {
  public:
    /// `every`: frames; of every so-manieth one the mesh is compared with all posts.
    LodGoals(std::shared_ptr<const terrain::Database> field, GoalPaths paths, FlightOptions flight,
             std::size_t every);

    /// Goals 1 (triangles), 2 (post error), 5 (pops), 4 (selection), 7 (heap), in this order; `report` hears
    /// of each line. On failure: one sentence.
    [[nodiscard]] tl::expected<GoalFigures, std::string> measure(
        const std::function<void(const GoalLine&)>& report);

  private:
    using Done = tl::expected<void, std::string>;
    [[nodiscard]] Done triangles();
    [[nodiscard]] Done culling();
    [[nodiscard]] Done post_error();
    [[nodiscard]] Done pops();
    [[nodiscard]] Done selection();
    [[nodiscard]] Done blocks();
    [[nodiscard]] tl::expected<FlightFigures, std::string> fly(std::vector<terrain::LodView> views,
                                                               double tau_px, double slack_share,
                                                               const MeasureOptions& options);
    void note(std::string text) { figures_.notes.push_back(std::move(text)); }
    void line(GoalLine line);

    FullSurface surface_;
    GoalPaths paths_;
    std::size_t every_;
    std::shared_ptr<const terrain::Database> field_;
    FlightOptions flight_options_;
    std::unique_ptr<LodFlight> flight_;
    std::function<void(const GoalLine&)> report_;
    GoalFigures figures_;
    double matched_tau_px_ = 1.0;  ///< at which the post error's p99.9 is kComparedP999Px on cruise
};

/// The field's measure of comparison.
inline constexpr double kComparedP999Px = 1.12;

}  // namespace eyepoint::tools
