#include "tools/bench/goals/goal_bench.hpp"

#include <utility>

#include "ig/lod_view.hpp"
#include "terrain/geodesy/earth.hpp"
#include "tools/bench/eyes.hpp"

namespace eyepoint::tools {

namespace {

std::vector<ig::FlightEye> higher(std::vector<ig::FlightEye> eyes, double higher_m) {
    for (ig::FlightEye& eye : eyes) {
        terrain::Geodetic& place = eye.eyepoint.place;
        place.height = terrain::EllipsoidalHeight{place.height.metres() + higher_m};
        eye.eyepoint.view.eye_ecef = terrain::to_ecef(place);
    }
    return eyes;
}

/// North, and so far down.
std::vector<ig::FlightEye> looking_down(std::vector<ig::FlightEye> eyes, double down_deg) {
    constexpr double kRadPerDeg = 0.017453292519943295;
    for (ig::FlightEye& eye : eyes) {
        const terrain::Geodetic& place = eye.eyepoint.place;
        const glm::dmat3 body =
            terrain::body_axes(place.latitude_deg, place.longitude_deg, {0.0, -down_deg * kRadPerDeg, 0.0});
        eye.eyepoint.view.axes = {body[1], -body[2], -body[0]};
    }
    return eyes;
}

std::vector<terrain::LodView> views_of(const std::vector<ig::FlightEye>& eyes, double tau_px,
                                       double slack_px) {
    std::vector<terrain::LodView> views;
    for (const ig::FlightEye& eye : eyes) views.push_back(ig::lod_view(eye.eyepoint.view, tau_px, slack_px));
    return views;
}

}  // namespace

std::vector<ig::FlightEye> every_nth(const std::vector<ig::FlightEye>& eyes, std::size_t n) {
    std::vector<ig::FlightEye> result;
    for (std::size_t i = 0; i < eyes.size(); i += n) result.push_back(eyes[i]);
    return result;
}

tl::expected<GoalBench, std::string> GoalBench::open(GoalSettings settings) {
    constexpr double kLowerM = 700.0, kHigherM = 4000.0;
    auto field = terrain::Database::open(settings.terrain);
    if (!field) return tl::unexpected(field.error());
    auto cruise = read_eyes({.file = settings.paths / "cruise.csv", .size = kGoalPicture});
    if (!cruise) return tl::unexpected(cruise.error());
    auto sweep = read_eyes({.file = settings.paths / "sweep.csv", .size = kGoalPicture});
    if (!sweep) return tl::unexpected(sweep.error());
    GoalPaths paths{.cruise = *cruise,
                    .sweep = *std::move(sweep),
                    .low_cruise = higher(*cruise, -kLowerM),
                    .high_cruise = looking_down(higher(*cruise, kHigherM), 45.0),
                    .down_cruise = looking_down(*cruise, 90.0)};
    return GoalBench(std::move(settings), std::move(paths),
                     std::make_shared<const terrain::Database>(*std::move(field)));
}

GoalBench::GoalBench(GoalSettings settings, GoalPaths paths, std::shared_ptr<const terrain::Database> field)
    : settings_(std::move(settings)), paths_(std::move(paths)), field_(std::move(field)), surface_(field_) {}

tl::expected<LodFlight*, std::string> GoalBench::flight(const std::string& lod_method, bool cull) {
    auto& flight = flights_[{lod_method, cull}];
    if (!flight) {
        auto made = LodFlight::create(
            field_, {.lod_method = lod_method, .cull = cull, .allocations = settings_.allocations});
        if (!made) return tl::unexpected(made.error());
        flight = *std::move(made);
    }
    return flight.get();
}

tl::expected<FlightFigures, std::string> GoalBench::fly(const std::vector<ig::FlightEye>& eyes,
                                                        const GoalFlight& how,
                                                        const MeasureOptions& options) {
    const auto flown = flight(how.lod_method, how.cull);
    if (!flown) return tl::unexpected(flown.error());
    const auto frames =
        measure_flight(**flown, surface_, views_of(eyes, how.tau_px, how.slack_share * how.tau_px), options);
    if (!frames) return tl::unexpected(frames.error());
    return summarise(*frames);
}

tl::expected<FlightFigures, std::string> GoalBench::fly_anew(const std::vector<ig::FlightEye>& eyes,
                                                             const FlightOptions& flight, double tau_px,
                                                             double slack_px, const MeasureOptions& options) {
    const auto flown = LodFlight::create(field_, flight);
    if (!flown) return tl::unexpected(flown.error());
    const auto frames = measure_flight(**flown, surface_, views_of(eyes, tau_px, slack_px), options);
    if (!frames) return tl::unexpected(frames.error());
    return summarise(*frames);
}

tl::expected<ToleranceMatch, std::string> GoalBench::match(const std::string& lod_method,
                                                           const std::vector<ig::FlightEye>& path) {
    const std::tuple key{lod_method, path.data()};
    if (const auto found = matches_.find(key); found != matches_.end()) return found->second;
    const auto flown = flight(lod_method, false);
    if (!flown) return tl::unexpected(flown.error());
    auto found = match_p999(**flown, surface_, views_of(every_nth(path, settings_.every), 1.0, 0.0),
                            kComparedP999Px, 0.0, MeasureOptions{});
    if (found) matches_.emplace(key, *found);
    return found;
}

}  // namespace eyepoint::tools
