#include "tools/bench/measure/error_picture.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "terrain/geodesy/earth.hpp"
#include "tests/tools/bench/small_flight.hpp"

namespace eyepoint::tools {
namespace {

using Colour = std::array<std::uint8_t, 3>;

TEST(ErrorColour, RunsFromBlueOverYellowAtTheToleranceToRed) {
    EXPECT_EQ(error_colour(0.0), (Colour{20, 30, 90}));
    EXPECT_EQ(error_colour(1.0), (Colour{250, 220, 40}));
    EXPECT_EQ(error_colour(2.0), (Colour{220, 20, 20}));
    EXPECT_EQ(error_colour(50.0), error_colour(2.0));
}

/// The camera of testing::look_north().
PictureCamera camera_north(double latitude_deg, double longitude_deg, double down_deg) {
    const glm::dmat3 enu = terrain::east_north_up(latitude_deg, longitude_deg);
    const double down = down_deg * 3.14159265358979323846 / 180.0;
    const glm::dvec3 forward = enu[1] * std::cos(down) - enu[2] * std::sin(down);
    const double half_width = std::sqrt(1.0 / 3.0), half_height = half_width * 0.75;
    return {{enu[0], glm::cross(enu[0], forward), -forward},
            -half_width,
            half_width,
            -half_height,
            half_height,
            640,
            480};
}

std::size_t pixels_above_the_legend(const ErrorPicture& picture, const Colour& colour) {
    constexpr int kLegendPx = 12;
    const std::size_t end = static_cast<std::size_t>(picture.width_px) *
                            static_cast<std::size_t>(picture.height_px - kLegendPx) * 3;
    std::size_t count = 0;
    for (std::size_t i = 0; i < end; i += 3) {
        count +=
            picture.rgb[i] == colour[0] && picture.rgb[i + 1] == colour[1] && picture.rgb[i + 2] == colour[2];
    }
    return count;
}

TEST(ErrorPicture, AHoleIsMagentaAndWhatIsExactIsBlue) {
    testing::SmallFlight flight{testing::small_hills()};
    const auto view = testing::look_north(46.4, 8.25, 6000.0, 30.0, 0.004);
    const DrawnMesh mesh = flight.mesh(view);
    const PostView post_view{view, 40000.0};
    const PictureCamera camera = camera_north(46.4, 8.25, 30.0);
    constexpr Colour kHole{255, 0, 255}, kGrey{90, 90, 90};

    const ErrorPicture whole = paint_error(flight.measure(mesh, view), post_view, camera);
    EXPECT_EQ(pixels_above_the_legend(whole, kHole), 0U);
    EXPECT_GT(pixels_above_the_legend(whole, kGrey), 0U);  // the sky

    DrawnMesh torn = mesh;
    torn.triangles.resize(torn.triangles.size() / 2);
    torn.parts.resize(1);
    torn.parts[0].first_triangle = torn.parts[0].end_triangle = 0;
    const ErrorPicture holes = paint_error(flight.measure(torn, view), post_view, camera);
    EXPECT_GT(pixels_above_the_legend(holes, kHole), 1000U);
}

}  // namespace
}  // namespace eyepoint::tools
