/// The static mesh that the price of level of detail is measured against draws the same triangles.
#include <cmath>
#include <cstdlib>
#include <ostream>
#include <string>

#include <gtest/gtest.h>

#include "tests/picture/flights.hpp"
#include "tests/picture/renderer.hpp"

namespace eyepoint::testing {
namespace {

constexpr ig::PictureSize kSize{480, 270};

struct Way {
    std::string name;
    std::string lod_method;
    ig::Shading shading = ig::Shading::Deferred;
};

void PrintTo(const Way& way, std::ostream* out) { *out << way.name; }

class StillMesh : public ::testing::TestWithParam<Way> {};

/// Mean difference of colour channels, 8-bit steps.
double mean_difference(const ig::Picture& a, const ig::Picture& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.rgba.size(); ++i)
        sum += i % 4 == 3 ? 0.0 : std::abs(static_cast<double>(a.rgba[i]) - static_cast<double>(b.rgba[i]));
    return sum / (0.75 * static_cast<double>(a.rgba.size()));
}

TEST_P(StillMesh, LooksAsTheFrameItWasTakenFromAtTheSameDistances) {
    ig::SceneOptions options;
    options.lod_method = GetParam().lod_method;
    options.shading = GetParam().shading;
    Renderer renderer{open_synthetic_terrain(), kSize, options};
    // A few frames on the way there, so that vertices are under way.
    const auto eyes = eyes_of(sample_flight(), kSize, 10.0);
    const std::size_t middle = eyes.size() / 2;
    for (std::size_t i = middle - 5; i < middle; ++i) (void)renderer.draw_complete(eyes[i].eyepoint.view);
    const ig::View& view = eyes[middle].eyepoint.view;
    (void)renderer.draw_complete(view);
    const DrawnPicture complete = renderer.draw_distances(view);
    const DrawnPicture still = renderer.draw_still(view);
    keep_for_looking(complete.picture, "drawn-" + GetParam().name);
    keep_for_looking(still.picture, "still-" + GetParam().name);
    // A vertex that has slid has a place and a normal of its own, which are rounded to the block's formats.
    EXPECT_LT(mean_difference(complete.picture, still.picture), 1.0);
    std::size_t ground = 0, farther = 0;
    for (std::size_t i = 0; i < still.distance_m.size(); ++i) {
        ground += complete.distance_m[i] > 0.0 ? 1 : 0;
        farther +=
            std::abs(still.distance_m[i] - complete.distance_m[i]) > 1e-3 * complete.distance_m[i] ? 1 : 0;
    }
    EXPECT_GT(ground, still.distance_m.size() / 4);
    // Positions are rounded once more: an edge between near and far may fall a pixel beside where it was.
    EXPECT_LT(farther, still.distance_m.size() / 500);
}

INSTANTIATE_TEST_SUITE_P(Ways, StillMesh,
                         ::testing::Values(Way{"NestedDeferred", "nested", ig::Shading::Deferred},
                                           Way{"NestedForward", "nested", ig::Shading::Forward},
                                           Way{"TileDeferred", "tile", ig::Shading::Deferred},
                                           Way{"TileForward", "tile", ig::Shading::Forward},
                                           Way{"BintreeDeferred", "bintree", ig::Shading::Deferred},
                                           Way{"BintreeForward", "bintree", ig::Shading::Forward},
                                           Way{"SelectiveDeferred", "selective", ig::Shading::Deferred},
                                           Way{"SelectiveForward", "selective", ig::Shading::Forward},
                                           Way{"HyperblockDeferred", "hyperblock", ig::Shading::Deferred},
                                           Way{"HyperblockForward", "hyperblock", ig::Shading::Forward}),
                         [](const auto& instance) { return instance.param.name; });

}  // namespace
}  // namespace eyepoint::testing
