/// What the goals are measured with: the benchmark field, its paths, and flights over it without drawing.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include <tl/expected.hpp>

#include "ig/recorded_flight.hpp"
#include "terrain/database/database.hpp"
#include "tools/bench/measure/flight_measure.hpp"
#include "tools/bench/measure/tolerance_match.hpp"

namespace eyepoint::tools {

/// The field's measure of comparison: percentile 99.9 of the post error, pixels.
inline constexpr double kComparedP999Px = 1.12;
inline constexpr ig::PictureSize kGoalPicture{800, 800};
/// Slack, pixels a pixel of tolerance.
inline constexpr double kSlackShare = 0.1;

struct GoalSettings {
    std::filesystem::path terrain;                ///< the benchmark field's database
    std::filesystem::path paths;                  ///< folder of cruise.csv and sweep.csv
    std::filesystem::path programs;               ///< folder of eyepoint and eyepoint-bench
    std::optional<std::filesystem::path> flight;  ///< recorded flight for the goals of a frame; none: cruise
    std::filesystem::path flight_terrain;         ///< what it is flown over
    std::string lod_method = "nested";
    std::size_t every = 20;  ///< frames: of every so-manieth one the mesh is compared with all posts
    /// Heap allocations of the calling thread so far; nullptr: not counted.
    std::uint64_t (*allocations)() = nullptr;
};

/// The benchmark's paths. A view's tolerance is set by who flies it.
struct GoalPaths {
    std::vector<ig::FlightEye> cruise;
    std::vector<ig::FlightEye> sweep;
    std::vector<ig::FlightEye> low_cruise;   ///< cruise 700 m lower: 300 m above smoothed ground
    std::vector<ig::FlightEye> high_cruise;  ///< 5,000 m above smoothed ground, looking 45 degrees down
    std::vector<ig::FlightEye> down_cruise;  ///< cruise, looking straight down
};

[[nodiscard]] std::vector<ig::FlightEye> every_nth(const std::vector<ig::FlightEye>& eyes, std::size_t n);

/// How a path is flown without drawing.
struct GoalFlight {
    std::string lod_method;
    double tau_px = 1.0;
    double slack_share = 0.0;  ///< of tau
    bool cull = false;
};

/// Thread use: one thread.
class GoalBench {
  public:
    /// On failure (no database, no paths): one sentence.
    [[nodiscard]] static tl::expected<GoalBench, std::string> open(GoalSettings settings);

    [[nodiscard]] const GoalSettings& settings() const { return settings_; }
    [[nodiscard]] const GoalPaths& paths() const { return paths_; }
    [[nodiscard]] const std::shared_ptr<const terrain::Database>& field() const { return field_; }

    /// On failure: one sentence.
    [[nodiscard]] tl::expected<FlightFigures, std::string> fly(const std::vector<ig::FlightEye>& eyes,
                                                               const GoalFlight& flight,
                                                               const MeasureOptions& options);
    /// The same by a method with options, loaded for this and gone after it; slack in pixels.
    [[nodiscard]] tl::expected<FlightFigures, std::string> fly_anew(const std::vector<ig::FlightEye>& eyes,
                                                                    const FlightOptions& flight,
                                                                    double tau_px, double slack_px,
                                                                    const MeasureOptions& options);
    /// The tolerance at which the post error of a path of paths() is kComparedP999Px, over every so-manieth
    /// frame (GoalSettings::every), without slack; looked for once a method and path. On failure: one
    /// sentence.
    [[nodiscard]] tl::expected<ToleranceMatch, std::string> match(const std::string& lod_method,
                                                                  const std::vector<ig::FlightEye>& path);

  private:
    GoalBench(GoalSettings settings, GoalPaths paths, std::shared_ptr<const terrain::Database> field);
    [[nodiscard]] tl::expected<LodFlight*, std::string> flight(const std::string& lod_method, bool cull);

    GoalSettings settings_;
    GoalPaths paths_;
    std::shared_ptr<const terrain::Database> field_;
    FullSurface surface_;
    std::map<std::tuple<std::string, bool>, std::unique_ptr<LodFlight>> flights_;
    std::map<std::tuple<std::string, const ig::FlightEye*>, ToleranceMatch> matches_;
};

/// No mesh is looked at.
inline constexpr MeasureOptions kSelectionAlone{
    .every = std::size_t{1} << 30U, .posts = false, .pops = false, .faults = false};

}  // namespace eyepoint::tools
