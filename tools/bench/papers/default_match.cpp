#include "tools/bench/papers/default_match.hpp"

namespace eyepoint::tools {

namespace {
constexpr MeasureOptions kPostsAlone{.pops = false, .faults = false};
}  // namespace

tl::expected<ToleranceMatch, std::string> match_default(
    const std::shared_ptr<const terrain::Database>& database, FullSurface& surface,
    std::span<const terrain::LodView> views, double p999_px) {
    auto flight = LodFlight::create(database, {});
    if (!flight) return tl::unexpected(flight.error());
    return match_p999(**flight, surface, views, p999_px, 0.0, kPostsAlone);
}

tl::expected<ToleranceMatch, std::string> match_default(
    const std::shared_ptr<const terrain::Database>& database, const FlightOptions& method,
    std::span<const terrain::LodView> views) {
    auto flight = LodFlight::create(database, method);
    if (!flight) return tl::unexpected(flight.error());
    FullSurface surface(database);
    const auto frames = measure_flight(**flight, surface, views, kPostsAlone);
    if (!frames) return tl::unexpected(frames.error());
    return match_default(database, surface, views, summarise(*frames).posts.error.percentile(0.999));
}

}  // namespace eyepoint::tools
