/// The tolerance at which a method's post error is a given one: what methods are compared at.
#pragma once

#include <span>
#include <string>

#include <tl/expected.hpp>

#include "tools/bench/measure/flight_measure.hpp"

namespace eyepoint::tools {

struct ToleranceMatch {
    double tau_px = 0.0;    ///< the greatest found
    FlightFigures figures;  ///< at it, on the views given
};

/// Finds by bisection the greatest tolerance (kLeastTauPx..kMostTauPx, to 1%) at which the percentile 99.9 of
/// the post error over all posts of all views is at most p999_px. slack_share: slack as a share of the
/// tolerance. On failure (not even the least will do; unreadable tile): one sentence.
inline constexpr double kLeastTauPx = 0.05, kMostTauPx = 100.0;
[[nodiscard]] tl::expected<ToleranceMatch, std::string> match_p999(LodFlight& flight, FullSurface& surface,
                                                                   std::span<const terrain::LodView> views,
                                                                   double p999_px, double slack_share,
                                                                   const MeasureOptions& options);

}  // namespace eyepoint::tools
