/// What the heights of a file are measured from.
#pragma once

#include <optional>
#include <string_view>

#include "terrain/geodesy/geoid.hpp"
#include "tools/terrain/mosaic_grid.hpp"

namespace eyepoint::tools {

/// Name for people and for the manifest: "EGM96" or "WGS84 ellipsoid".
[[nodiscard]] std::string_view name_of(VerticalDatum datum);
/// "egm96" or "ellipsoid".
[[nodiscard]] std::optional<VerticalDatum> vertical_datum_named(std::string_view name);

/// Turns ellipsoidal heights into MSL heights, post by post. The mosaic is joined in MSL, where the sea is
/// flat, and converted to ellipsoidal heights once, at the places that are asked for; at a file's own posts
/// the two conversions cancel to the last float bit (0.5 mm at 8 km).
[[nodiscard]] HeightGrid to_msl(HeightGrid ellipsoidal, const terrain::Geoid& geoid);

}  // namespace eyepoint::tools
