#include <gtest/gtest.h>

#include "ig/eyepoint.hpp"
#include "tests/support/analytic_terrain.hpp"

namespace eyepoint::ig {
namespace {

constexpr double kHeightStepM = 1.0 / 16.0;

TEST(GroundClamp, ClampedAltitudeIsAboveTheTerrainNotTheSea) {
    const testing::AnalyticPlanet planet{{.half_size_deg = 0.1, .detail_depth = 8}};
    terrain::SurfaceHeight surface(planet.database());
    const EyepointReading reading{{}, config::VerticalDatum::Ellipsoid, nullptr, &surface};
    const terrain::TileId tile = terrain::tile_at(46.51, 8.21, planet.terrain().detail_depth);
    const double latitude = terrain::post_latitude_deg(tile, 3),
                 longitude = terrain::post_longitude_deg(tile, 4);
    net::HostState state;
    state.entities[0] = {.latitude_deg = latitude,
                         .longitude_deg = longitude,
                         .altitude_m = 2.5,
                         .attitude = {},
                         .above_ground = true};
    const double ground_m = testing::analytic_height_m(planet.terrain(), latitude, longitude);

    EXPECT_NEAR(eyepoint_of(state, reading, {64, 64})->place.height.metres(), ground_m + 2.5, kHeightStepM);
    state.entities[0].above_ground = false;
    EXPECT_NEAR(eyepoint_of(state, reading, {64, 64})->place.height.metres(), 2.5, 1e-6);
}

}  // namespace
}  // namespace eyepoint::ig
