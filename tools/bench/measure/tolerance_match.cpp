#include "tools/bench/measure/tolerance_match.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace eyepoint::tools {

namespace {

tl::expected<FlightFigures, std::string> at_tolerance(LodFlight& flight, FullSurface& surface,
                                                      std::span<const terrain::LodView> views, double tau_px,
                                                      double slack_share, const MeasureOptions& options) {
    std::vector<terrain::LodView> changed(views.begin(), views.end());
    for (terrain::LodView& view : changed) {
        view.tau_px = tau_px;
        view.slack_px = slack_share * tau_px;
    }
    const auto frames = measure_flight(flight, surface, changed, options);
    if (!frames) return tl::unexpected(frames.error());
    return summarise(*frames);
}

}  // namespace

tl::expected<ToleranceMatch, std::string> match_p999(LodFlight& flight, FullSurface& surface,
                                                     std::span<const terrain::LodView> views, double p999_px,
                                                     double slack_share, const MeasureOptions& options) {
    MeasureOptions posts_alone = options;
    posts_alone.every = 1;
    posts_alone.pops = false;
    posts_alone.faults = false;
    constexpr double kStep = 1.01;
    ToleranceMatch best;
    double low = 0.0, high = 0.0;  // 0: not known yet
    double tau = std::clamp(p999_px, kLeastTauPx, kMostTauPx);
    while (low == 0.0 || high == 0.0 || high / low > kStep) {
        auto figures = at_tolerance(flight, surface, views, tau, slack_share, posts_alone);
        if (!figures) return tl::unexpected(figures.error());
        const bool good = figures->posts.error.percentile(0.999) <= p999_px;
        (good ? low : high) = tau;
        if (good) best = {tau, std::move(*figures)};
        if (tau == (good ? kMostTauPx : kLeastTauPx)) break;
        // Until both sides are known, by halves and doubles.
        tau = low == 0.0 ? tau / 2.0 : high == 0.0 ? tau * 2.0 : std::sqrt(low * high);
        tau = std::clamp(tau, kLeastTauPx, kMostTauPx);
    }
    if (best.tau_px == 0.0)
        return tl::unexpected(fmt::format("no tolerance gives a post error of {} pixels", p999_px));
    return best;
}

}  // namespace eyepoint::tools
