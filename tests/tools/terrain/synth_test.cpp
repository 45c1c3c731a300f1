#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "tools/terrain/synth_noise.hpp"
#include "tools/terrain/synth_surface.hpp"

namespace eyepoint::tools {
namespace {

const terrain::Geoid& geoid() {
    static const auto grid = terrain::Geoid::load(EYEPOINT_BINARY_DIR "/share/eyepoint/egm96-15.pgm");
    return *grid;
}

const SynthSurface& default_surface() {
    static const auto surface = SynthSurface::make({}, geoid());
    return *surface;
}

// The flight of the sample capture: from 46.4024 N 8.1363 E to 46.4159 N 8.1743 E at 3 035 m to 3 056 m MSL,
// read from its packets; half a kilometre to either side.
TEST(Synth, TheSampleFlightClearsTheGroundAndSeesHigherPeaks) {
    const SynthSurface& surface = default_surface();
    double highest_below = 0.0;
    for (double share = 0.0; share <= 1.0; share += 0.02) {
        for (double aside = -0.005; aside <= 0.005; aside += 0.001) {
            highest_below = std::max(
                highest_below, surface.at(46.4024 + share * 0.0135 + aside, 8.1363 + share * 0.0380).msl_m);
        }
    }
    EXPECT_LT(highest_below, 3'035.0 - 150.0);
    double highest_around = 0.0;
    for (double north = -0.2; north <= 0.2; north += 0.002) {
        for (double east = -0.25; east <= 0.25; east += 0.002) {
            highest_around = std::max(highest_around, surface.at(46.41 + north, 8.155 + east).msl_m);
        }
    }
    EXPECT_GT(highest_around, 3'056.0);
}

double slope_deg(const SynthSurface& surface, double latitude, double longitude) {
    constexpr double kApartM = 60.0, kMetresPerDegree = 111'320.0;
    const double step = kApartM / kMetresPerDegree;
    const double here = surface.at(latitude, longitude).msl_m;
    const double north = surface.at(latitude + step, longitude).msl_m - here;
    const double east = surface.at(latitude, longitude + step / 0.6895).msl_m - here;
    return std::atan(std::hypot(north, east) / kApartM) * 180.0 / std::numbers::pi;
}

// Like the Alps: on the elevation tile N46E008, 57 % of the ground within 12 km of 46.41 N 8.155 E is steeper
// than 25 degrees and 80 % steeper than 15, over 60 m; a twentieth of it lies below 1,268 m, the summits
// reach 3,921 m.
TEST(Synth, TheMountainsAreAsSteepAndHighAsTheAlps) {
    const SynthSurface& surface = default_surface();
    int places = 0, steep = 0, sloping = 0;
    double lowest = 9e3, highest = 0.0;
    for (double north = -0.1; north <= 0.1; north += 0.001) {
        for (double east = -0.145; east <= 0.145; east += 0.0015) {
            const double degrees = slope_deg(surface, 46.41 + north, 8.155 + east);
            ++places;
            steep += degrees > 25.0 ? 1 : 0;
            sloping += degrees > 15.0 ? 1 : 0;
            const double msl_m = surface.at(46.41 + north, 8.155 + east).msl_m;
            lowest = std::min(lowest, msl_m);
            highest = std::max(highest, msl_m);
        }
    }
    EXPECT_NEAR(static_cast<double>(steep) / places, 0.57, 0.15);
    EXPECT_NEAR(static_cast<double>(sloping) / places, 0.80, 0.10);
    EXPECT_NEAR(highest, 3'921.0, 400.0);
    EXPECT_LT(lowest, 1'350.0);
}

TEST(Synth, TheFloorUnderTheFlightIsABroadValley) {
    for (double share = 0.0; share <= 1.0; share += 0.25) {
        const double latitude = 46.4024 + share * 0.0135, longitude = 8.1363 + share * 0.0380;
        int level = 0;
        // Across the valley, 100 m a step.
        for (int step = -25; step <= 25; ++step) {
            const double msl_m =
                default_surface().at(latitude + step * 0.00079, longitude - step * 0.00063).msl_m;
            level += msl_m > 1'150.0 && msl_m < 1'450.0 ? 1 : 0;
        }
        EXPECT_GE(level, 10);
    }
}

TEST(Synth, NothingIsMadeOnceCancelled) {
    int asked = 0;
    EXPECT_FALSE(SynthSurface::make({}, geoid(), [&asked] { return ++asked > 3; }));
    EXPECT_EQ(asked, 4);
}

TEST(Synth, HasLandAndWater) {
    const SynthSurface& surface = default_surface();
    int sea = 0, lake = 0, land = 0;
    for (double latitude = 45.85; latitude < 47.05; latitude += 0.004) {
        for (double longitude = 7.65; longitude < 8.85; longitude += 0.004) {
            const auto place = surface.at(latitude, longitude);
            ++(place.water ? (place.msl_m == 0.0 ? sea : lake) : land);
        }
    }
    EXPECT_GT(sea, 1'000);
    EXPECT_GT(lake, 20);
    EXPECT_GT(land, 50'000);
}

// The planet has no seam: 180 E is 180 W, and every longitude at a pole is one place. A hair of rounding
// aside.
TEST(Synth, TheAntimeridianAndThePolesAreWhole) {
    const SynthSurface& surface = default_surface();
    for (double latitude = -89.0; latitude < 90.0; latitude += 1.7) {
        EXPECT_NEAR(surface.at(latitude, 180.0).msl_m, surface.at(latitude, -180.0).msl_m, 1e-3);
    }
    for (double longitude = -180.0; longitude < 180.0; longitude += 30.0) {
        EXPECT_NEAR(surface.at(90.0, longitude).msl_m, surface.at(90.0, 0.0).msl_m, 1e-3);
    }
}

TEST(Synth, TheSameSeedGivesTheSameBitsAndAnotherAnother) {
    const auto again = SynthSurface::make({}, geoid());
    ASSERT_TRUE(again);
    double differs = 0.0;
    for (int i = 0; i < 2'000; ++i) {
        const double latitude = 45.9 + 0.0005 * i, longitude = 7.7 + 0.0005 * i;
        EXPECT_EQ(again->at(latitude, longitude).msl_m, default_surface().at(latitude, longitude).msl_m);
        differs = std::max(differs, std::abs(gradient_noise({0.37 * i, 0.21, 0.7}, 1) -
                                             gradient_noise({0.37 * i, 0.21, 0.7}, 2)));
    }
    EXPECT_GT(differs, 0.1);
}

TEST(Synth, BenchmarkFieldIsWholeTiles) {
    EXPECT_EQ(depth_for_spacing(40.0), 14U);
    EXPECT_EQ(depth_for_spacing(77.0), 13U);
}

}  // namespace
}  // namespace eyepoint::tools
