#include "tools/terrain/vertical_datum.hpp"

namespace eyepoint::tools {

std::string_view name_of(VerticalDatum datum) {
    return datum == VerticalDatum::Egm96 ? "EGM96" : "WGS84 ellipsoid";
}

std::optional<VerticalDatum> vertical_datum_named(std::string_view name) {
    if (name == "egm96") return VerticalDatum::Egm96;
    if (name == "ellipsoid") return VerticalDatum::Ellipsoid;
    return std::nullopt;
}

HeightGrid to_msl(HeightGrid ellipsoidal, const terrain::Geoid& geoid) {
    HeightGrid& grid = ellipsoidal;
    for (int row = 0; row < grid.rows; ++row) {
        for (int column = 0; column < grid.columns; ++column) {
            float& height = grid.heights_m[grid.index(column, row)];
            if (is_void(height)) continue;
            const LatLon place =
                grid.mapping.to_place({static_cast<double>(column), static_cast<double>(row)});
            height = static_cast<float>(height - geoid.undulation_m(place.latitude_deg, place.longitude_deg));
        }
    }
    return ellipsoidal;
}

}  // namespace eyepoint::tools
