/// A feature of one post beside a tile's edge is drawn at its height: the edge's own chain of levels leaves
/// it alone, and the mesh must not lose it between two tiles.
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "tests/picture/renderer.hpp"
#include "tests/picture/spike_terrain.hpp"
#include "tests/support/analytic_terrain.hpp"

namespace eyepoint::testing {
namespace {

constexpr ig::PictureSize kSize{640, 480};
constexpr double kTauPx = 1.5;
constexpr unsigned kDepth = 17;
constexpr double kApexM = 12.0;  ///< over sides of one post, 4.8 m
constexpr double kWayM = 60.0;
constexpr double kEyeHeightM = 2.0;
/// How far below the apex a pixel's centre may first be inside the spike, which is thinner than a pixel
/// there.
constexpr double kPointPx = 2.0;

/// Rows north and columns east of a tile's corner.
struct FromCorner {
    std::string name;
    int rows = 0, columns = 0;
};
void PrintTo(const FromCorner& place, std::ostream* out) { *out << place.name; }

Place place_of(const FromCorner& from_corner) {
    const double tile_deg = std::ldexp(180.0, -static_cast<int>(kDepth));
    const double spacing_deg = tile_deg / 32.0;
    const double row = std::round((90.0 + 46.5) / tile_deg), column = std::round((180.0 + 8.25) / tile_deg);
    return {row * tile_deg - 90.0 + from_corner.rows * spacing_deg,
            column * tile_deg - 180.0 + from_corner.columns * spacing_deg, kApexM};
}

/// The first row from the top that holds terrain above the level of the eye.
int first_row(const ig::Picture& picture) {
    for (int y = 0; y < picture.size.height_px; ++y) {
        for (int x = 0; x < picture.size.width_px; ++x) {
            if (!is_sentinel(picture, x, y)) return y;
        }
    }
    return picture.size.height_px;
}

class SpikeProof : public ::testing::TestWithParam<FromCorner> {};

TEST_P(SpikeProof, StandsAtFullHeight) {
    const Spike spike{place_of(GetParam()), kDepth, 1, 1};
    ScratchFolder scratch;
    ig::SceneOptions options;
    options.sentinel = true;
    options.lod_method = "nested";
    options.tau_px = kTauPx;
    Renderer renderer(make_spike_database(spike, scratch.path() / "terrain"), kSize, options);
    for (const double azimuth_deg : {20.0, 110.0, 200.0, 290.0}) {
        Place eye = moved(spike.apex, azimuth_deg, kWayM);
        eye.height_m = kEyeHeightM;
        CameraPose pose = looking_at(eye, ecef_of(spike.apex));
        pose.width_px = kSize.width_px;
        pose.height_px = kSize.height_px;
        pose.pitch_deg = 0.0;
        const double apex_y = outline(spike, ReferenceCamera(pose)).apex.y;
        const ig::Picture picture = renderer.draw_complete(pose).picture;
        keep_for_looking(picture, "spike-" + GetParam().name + "-" + std::to_string(azimuth_deg));
        const double most_px = kTauPx * (1.0 + options.slack) + 0.5;
        EXPECT_GE(first_row(picture) + 0.5, apex_y - most_px) << "seen from " << azimuth_deg;
        EXPECT_LE(first_row(picture) + 0.5, apex_y + most_px + kPointPx) << "seen from " << azimuth_deg;
    }
}

INSTANTIATE_TEST_SUITE_P(BesideATilesEdge, SpikeProof,
                         ::testing::Values(FromCorner{"South", 1, 13}, FromCorner{"North", -1, 13},
                                           FromCorner{"West", 13, 1}, FromCorner{"East", 13, -1},
                                           FromCorner{"Corner", 1, 1}, FromCorner{"OnTheEdge", 0, 13},
                                           FromCorner{"OnTheCorner", 0, 0}),
                         [](const auto& instance) { return instance.param.name; });

}  // namespace
}  // namespace eyepoint::testing
