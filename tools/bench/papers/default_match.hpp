/// The default method, for comparison with a published one: where it errs as little.
#pragma once

#include <memory>
#include <span>
#include <string>

#include <tl/expected.hpp>

#include "tools/bench/measure/tolerance_match.hpp"

namespace eyepoint::tools {

/// The default at the greatest tolerance at which 99.9% of the posts err at most p999_px over the views,
/// whose own tolerance does not matter. surface: of the same database. On failure: one sentence.
[[nodiscard]] tl::expected<ToleranceMatch, std::string> match_default(
    const std::shared_ptr<const terrain::Database>& database, FullSurface& surface,
    std::span<const terrain::LodView> views, double p999_px);

/// The same where p999_px is what a method errs by over the views, at their tolerance.
[[nodiscard]] tl::expected<ToleranceMatch, std::string> match_default(
    const std::shared_ptr<const terrain::Database>& database, const FlightOptions& method,
    std::span<const terrain::LodView> views);

}  // namespace eyepoint::tools
