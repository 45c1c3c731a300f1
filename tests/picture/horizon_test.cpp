/// The drawn horizon of a bare ellipsoid against its closed form: within one pixel, from 2 m to 400 km.
///
/// A ray meets the ellipsoid where a quadratic has roots; the horizon is where its discriminant is 0. Along a
/// column (or row) of the picture the discriminant is itself quadratic, so three values give the place.
#include <array>
#include <cmath>
#include <cstdio>
#include <string>

#include <gtest/gtest.h>

#include "tests/picture/reference_camera.hpp"
#include "tests/picture/renderer.hpp"
#include "tests/support/analytic_terrain.hpp"

namespace eyepoint::testing {
namespace {

/// Half of it is the pixel's own: it is drawn or not as a whole.
constexpr double kLargestErrorPx = 1.0;
struct Ground {
    std::string name;
    double latitude_deg = 0.0;
    double longitude_deg = 0.0;
    std::string lod_method = "nested";
};

void PrintTo(const Ground& ground, std::ostream* out) { *out << ground.name; }

/// Rows from the top where the column's ray grazes the ellipsoid, in ascending order; none or two.
std::vector<double> horizon_rows(const ReferenceCamera& camera, double x) {
    // Values at rows 0, 500 and 1000 give the parabola a y^2 + b y + c.
    constexpr double kStep = 500.0;
    const double at0 = camera.ellipsoid_discriminant({x, 0.0}, 0.0);
    const double at1 = camera.ellipsoid_discriminant({x, kStep}, 0.0);
    const double at2 = camera.ellipsoid_discriminant({x, 2.0 * kStep}, 0.0);
    const double a = (at2 - 2.0 * at1 + at0) / (2.0 * kStep * kStep), b = (at1 - at0) / kStep - a * kStep;
    const double inside = b * b - 4.0 * a * at0;
    if (inside < 0.0) return {};
    const double q = -0.5 * (b + std::copysign(std::sqrt(inside), b));
    std::vector<double> rows{q / a, at0 / q};
    if (rows[0] > rows[1]) std::swap(rows[0], rows[1]);
    // The other branch of the cone that touches the ellipsoid lies behind the eye.
    std::erase_if(rows, [&](double y) {
        return !camera.ellipsoid_distance_m({x, y + 0.01}, 0.0) &&
               !camera.ellipsoid_distance_m({x, y - 0.01}, 0.0);
    });
    return rows;
}

/// Rows between which the column changes between terrain and sentinel.
std::vector<double> drawn_rows(const ig::Picture& picture, int x) {
    std::vector<double> rows;
    for (int y = 0; y + 1 < picture.size.height_px; ++y) {
        if (is_sentinel(picture, x, y) != is_sentinel(picture, x, y + 1)) rows.push_back(y + 1.0);
    }
    return rows;
}

struct Errors {
    double largest_px = 0.0;
    double sum_px = 0.0;
    int columns = 0;
};

/// Drawn against expected, in every column where the horizon is well inside the picture. A pixel is drawn or
/// not as a whole, so half a pixel of every difference is the pixels' own.
Errors compare(const ig::Picture& picture, const ReferenceCamera& camera) {
    Errors errors;
    for (int x = 0; x < picture.size.width_px; ++x) {
        const auto expected = horizon_rows(camera, x + 0.5);
        const auto drawn = drawn_rows(picture, x);
        for (const double row : expected) {
            if (row < 4.0 || row > picture.size.height_px - 4.0) continue;
            double nearest = picture.size.height_px;
            for (const double candidate : drawn)
                if (std::abs(candidate - row) < std::abs(nearest)) nearest = candidate - row;
            errors.largest_px = std::max(errors.largest_px, std::abs(nearest));
            errors.sum_px += nearest;
            ++errors.columns;
        }
    }
    return errors;
}

class Horizon : public ::testing::TestWithParam<Ground> {};

TEST_P(Horizon, IsWhereTheEllipsoidHasItWithinAPixel) {
    const ScratchFolder scratch;
    const AnalyticTerrain bare{
        .half_size_deg = 0.01, .detail_depth = 1, .planet_depth = 1, .amplitude_m = 0.0};
    ig::SceneOptions options;
    options.sentinel = true;
    // Grids hold the curve of the Earth closer than their tolerance, nested meshes to it.
    options.lod_method = GetParam().lod_method;
    options.tau_px = options.lod_method == "nested" ? 1.0 : 2.0;
    Renderer renderer(make_database(bare, scratch.path() / "terrain"), {1920, 1080}, options);
    constexpr std::array<double, 6> kHeightsM{2.0, 50.0, 1500.0, 12e3, 100e3, 400e3};
    constexpr std::array<double, 6> kAzimuthsDeg{0.0, 77.0, 161.0, 200.0, 270.0, 338.0};
    constexpr std::array<double, 6> kRollsDeg{0.0, 30.0, -12.0, 0.0, -35.0, 179.0};
    for (std::size_t i = 0; i < kHeightsM.size(); ++i) {
        for (std::size_t turn = 0; turn < 2; ++turn) {
            CameraPose pose{.place = {GetParam().latitude_deg, GetParam().longitude_deg, kHeightsM[i]}};
            pose.yaw_deg = kAzimuthsDeg[(i + 3 * turn) % kAzimuthsDeg.size()];
            pose.roll_deg = kRollsDeg[(i + turn) % kRollsDeg.size()];
            // So far below level that the horizon is in the picture: its dip on the sphere.
            constexpr double kEarthM = 6371e3;
            pose.pitch_deg = -std::acos(kEarthM / (kEarthM + kHeightsM[i])) * 180.0 / std::acos(-1.0) + 3.0;
            SCOPED_TRACE("height " + std::to_string(kHeightsM[i]) + " yaw " + std::to_string(pose.yaw_deg) +
                         " roll " + std::to_string(pose.roll_deg));
            const DrawnPicture drawn = renderer.draw_complete(pose);
            const Errors errors = compare(drawn.picture, ReferenceCamera(pose));
            keep_for_looking(drawn.picture, "horizon-" + GetParam().name + "-" +
                                                std::to_string(static_cast<int>(kHeightsM[i])) + "-" +
                                                std::to_string(turn));
            EXPECT_GT(errors.columns, 1000);
            EXPECT_LE(errors.largest_px, kLargestErrorPx);
            std::printf(
                "height %8.0f m, roll %4.0f: largest %.2f px, mean %+.3f px, %d columns, %lu triangles\n",
                kHeightsM[i], pose.roll_deg, errors.largest_px, errors.sum_px / errors.columns,
                errors.columns, static_cast<unsigned long>(drawn.statistics.triangles));
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Earth, Horizon,
                         ::testing::Values(Ground{"Equator", 0.0, 10.0}, Ground{"North47", 47.0, 8.0},
                                           Ground{"South60Antimeridian", -60.0, 179.9999},
                                           Ground{"NorthPole", 89.995, 120.0},
                                           Ground{"EquatorTile", 0.0, 10.0, "tile"},
                                           Ground{"North47Tile", 47.0, 8.0, "tile"},
                                           Ground{"South60AntimeridianTile", -60.0, 179.9999, "tile"},
                                           Ground{"NorthPoleTile", 89.995, 120.0, "tile"},
                                           Ground{"North47Bintree", 47.0, 8.0, "bintree"},
                                           Ground{"NorthPoleBintree", 89.995, 120.0, "bintree"},
                                           Ground{"North47Selective", 47.0, 8.0, "selective"},
                                           Ground{"NorthPoleSelective", 89.995, 120.0, "selective"},
                                           Ground{"North47Hyperblock", 47.0, 8.0, "hyperblock"},
                                           Ground{"NorthPoleHyperblock", 89.995, 120.0, "hyperblock"}),
                         [](const auto& instance) { return instance.param.name; });

}  // namespace
}  // namespace eyepoint::testing
