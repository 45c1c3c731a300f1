/// Planets that the tests of several methods fly over, and eyes there. Tests of one process share them.
#pragma once

#include <ostream>
#include <random>
#include <span>
#include <string>

#include <gtest/gtest.h>

#include "terrain/lod/lod_method.hpp"
#include "tests/support/analytic_terrain.hpp"

namespace eyepoint::testing {

/// Hills around 46.5 N 8.25 E, enough for meshes of 20 000 triangles.
inline constexpr AnalyticTerrain kHills{};
[[nodiscard]] const AnalyticPlanet& hills();
/// Without any; coarse, as tiles of sea are that nobody stores.
[[nodiscard]] const AnalyticPlanet& sea();

/// Where tiles meet in different ways.
struct Place {
    const char* name;
    const AnalyticPlanet& (*planet)();
};
inline void PrintTo(const Place& place, std::ostream* stream) { *stream << place.name; }
inline std::string place_name(const ::testing::TestParamInfo<Place>& info) { return info.param.name; }
/// Hills in the Alps, over the equator, the antimeridian and a pole.
[[nodiscard]] std::span<const Place> places();

/// An eye from 2 m to 600 km above the ground in and about the detail, looking anywhere, tolerance 0.5 to
/// 4.5 px.
[[nodiscard]] terrain::LodView random_view(const AnalyticTerrain& terrain, std::mt19937_64& random);

/// Over the middle of the hills, metres above the ellipsoid; towards a course, degrees down.
[[nodiscard]] terrain::LodView look_from(double height_m, double course_deg, double down_deg, double tau_px);

/// Over the hills, so many metres north-east of their middle, looking on and a little down.
[[nodiscard]] terrain::LodView along(double metres, double tau_px = 1.0, double slack_px = 0.1);

}  // namespace eyepoint::testing
