/// No cracks: in sentinel mode no pixel without terrain lies below the terrain's skyline (cracks.hpp says how
/// that is known), in frames of the sample flight over synthetic terrain and of a real flight over real
/// terrain, complete and while loads are arriving.
///
/// EYEPOINT_EVERY_FRAME=1 draws every frame (two hours of software GL on two cores); otherwise a share of
/// them that keeps ctest within minutes.
#include "tests/picture/cracks.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "tests/picture/flights.hpp"
#include "tests/picture/renderer.hpp"
#include "tests/support/analytic_terrain.hpp"

namespace eyepoint::testing {
namespace {

/// Below all terrain: the geoid is at most 107 m below the ellipsoid, and the sea is at the geoid; dry land
/// goes down to 430 m below the sea (the Dead Sea's shore).
constexpr double kLowestHeightM = -600.0;
/// While the first blocks arrive the root tiles are drawn, whose cells of 5.6 degrees cut up to 15.2 km into
/// the Earth: the sagitta of their diagonals, 885 km long.
constexpr double kLowestRootMeshM = -16e3;

bool every_frame() { return std::getenv("EYEPOINT_EVERY_FRAME") != nullptr; }

ig::SceneOptions sentinel_options() {
    ig::SceneOptions options;
    options.sentinel = true;
    return options;
}

struct Sweep {
    int frames = 0;
    int frames_with_cracks = 0;
    int frames_loading = 0;
};

enum class Loading { Complete, AsTheyArrive };

/// Draws every stride-th eye and looks for cracks. Every picture shows a good deal of terrain.
Sweep sweep(Renderer& renderer, const std::vector<ig::FlightEye>& eyes, std::size_t stride, Loading loading,
            const std::string& name) {
    constexpr int kLeastTerrainShare = 20;  // one pixel in so many
    Sweep result;
    ig::Picture picture;
    for (std::size_t i = 0; i < eyes.size(); i += every_frame() ? 1 : stride) {
        const ig::View& view = eyes[i].eyepoint.view;
        if (loading == Loading::Complete) {
            picture = renderer.draw_complete(view);
        } else {
            const ig::FrameStatistics statistics = renderer.draw_now(view, picture);
            result.frames_loading += statistics.loads_pending > 0 ? 1 : 0;
        }
        const CrackReport report =
            find_cracks(picture, view, loading == Loading::Complete ? kLowestHeightM : kLowestRootMeshM);
        ++result.frames;
        EXPECT_GT(report.terrain_pixels, view.width_px * view.height_px / kLeastTerrainShare)
            << name << ", frame " << i << ": hardly any terrain";
        if (report.total() == 0) continue;
        ++result.frames_with_cracks;
        const std::string file = std::string(EYEPOINT_BINARY_DIR) + "/tests/cracks-" + name + "-" +
                                 std::to_string(view.height_px) + "-" + std::to_string(i) + ".png";
        write_png(picture, file);
        ADD_FAILURE() << name << ", frame " << i << " at " << eyes[i].time_s << " s, " << view.width_px << "x"
                      << view.height_px << ": " << report.below_horizon
                      << " sentinel pixels below the horizon, " << report.under_terrain << " under terrain, "
                      << report.islands << " in islands; the first at " << report.first_x << " "
                      << report.first_y << "; see " << file;
    }
    std::printf("%s: %d frames of %zu drawn, %d with cracks, %d while loading\n", name.c_str(), result.frames,
                eyes.size(), result.frames_with_cracks, result.frames_loading);
    return result;
}

constexpr ig::PictureSize kSmall{640, 480};
constexpr ig::PictureSize kLarge{1920, 1080};
constexpr double kSampleRateHz = 30.0;
constexpr double kRealRateHz = 60.0;

TEST(SampleFlightHasNoCracks, At640x480) {
    Renderer renderer(open_synthetic_terrain(), kSmall, sentinel_options());
    EXPECT_GE(
        sweep(renderer, eyes_of(sample_flight(), kSmall, kSampleRateHz), 20, Loading::Complete, "sample")
            .frames,
        80);
}

TEST(SampleFlightHasNoCracks, At1920x1080) {
    Renderer renderer(open_synthetic_terrain(), kLarge, sentinel_options());
    EXPECT_GE(
        sweep(renderer, eyes_of(sample_flight(), kLarge, kSampleRateHz), 60, Loading::Complete, "sample")
            .frames,
        25);
}

/// Blocks arrive while the flight goes on: coarse ancestors stand in for the missing ones, beside finer ones.
TEST(SampleFlightHasNoCracks, WhileBlocksAreArriving) {
    const auto eyes = eyes_of(sample_flight(), kSmall, kSampleRateHz);
    int loading = 0;
    for (const std::size_t start : {std::size_t{0}, std::size_t{900}}) {
        Renderer renderer(open_synthetic_terrain(), kSmall, sentinel_options());
        const std::vector<ig::FlightEye> from(eyes.begin() + static_cast<std::ptrdiff_t>(start),
                                              eyes.begin() + static_cast<std::ptrdiff_t>(start + 60));
        loading += sweep(renderer, from, 1, Loading::AsTheyArrive, "streaming").frames_loading;
    }
    EXPECT_GT(loading, 10);  // else nothing was proven
}

/// By a method that makes the blocks' triangles anew, or slides them from frame to frame.
class OwnTriangles : public ::testing::TestWithParam<std::string> {};

TEST_P(OwnTriangles, SampleFlightHasNoCracksCompleteAndWhileBlocksAreArriving) {
    ig::SceneOptions options = sentinel_options();
    options.lod_method = GetParam();
    const auto eyes = eyes_of(sample_flight(), kSmall, kSampleRateHz);
    Renderer renderer(open_synthetic_terrain(), kSmall, options);
    const std::vector<ig::FlightEye> first(eyes.begin(), eyes.begin() + 60);
    EXPECT_GT(sweep(renderer, first, 1, Loading::AsTheyArrive, GetParam() + "-streaming").frames_loading, 5);
    EXPECT_GE(sweep(renderer, eyes, 30, Loading::Complete, GetParam()).frames, 50);
}

INSTANTIATE_TEST_SUITE_P(Methods, OwnTriangles,
                         ::testing::Values("bintree", "selective", "tile", "hyperblock"),
                         [](const auto& instance) { return instance.param; });

/// Real terrain from SRTM over a global DEM, made once for all tests of this file that need it.
class RealFlightHasNoCracks : public ::testing::Test {
  protected:
    void SetUp() override {
        if (!real_data()) GTEST_SKIP() << "EYEPOINT_REAL_DATA is not set: no real terrain to fly over";
        const std::filesystem::path folder = scratch_.path() / "alps";
        const std::filesystem::path elevation = *real_data() / "elevation";
        const std::string command = std::string(EYEPOINT_TERRAIN_PROGRAM) + " build --dem '" +
                                    (elevation / "alps/N46E008.tif").string() + "' '" +
                                    (elevation / "global/etopo2022_1536x1024.tif").string() + "' -o '" +
                                    folder.string() + "' > '" + (scratch_.path() / "log").string() + "' 2>&1";
        ASSERT_EQ(std::system(command.c_str()), 0) << command;
        database_ = open_database(folder);
        flight_ = *real_data() / "../flights/goms-c172.pcap";
    }

    ScratchFolder scratch_;
    std::shared_ptr<const terrain::Database> database_;
    std::filesystem::path flight_;
};

TEST_F(RealFlightHasNoCracks, At640x480And1920x1080AndWhileBlocksAreArriving) {
    {
        Renderer renderer(database_, kSmall, sentinel_options());
        const auto eyes = eyes_of(flight_, kSmall, kRealRateHz);
        const std::vector<ig::FlightEye> first(eyes.begin(), eyes.begin() + 60);
        EXPECT_GT(sweep(renderer, first, 1, Loading::AsTheyArrive, "real-streaming").frames_loading, 5);
        EXPECT_GE(sweep(renderer, eyes, 180, Loading::Complete, "real").frames, 60);
    }
    Renderer renderer(database_, kLarge, sentinel_options());
    EXPECT_GE(sweep(renderer, eyes_of(flight_, kLarge, kRealRateHz), 500, Loading::Complete, "real").frames,
              20);
}

/// That the search finds what it is for: holes of any size and place in a sound picture, upright and banked.
class CrackSearch : public ::testing::TestWithParam<std::size_t> {
  protected:
    CrackSearch() {
        const auto eyes = eyes_of(sample_flight(), kSmall, kSampleRateHz);
        view_ = eyes.at(GetParam()).eyepoint.view;
        Renderer renderer(open_synthetic_terrain(), kSmall, sentinel_options());
        sound_ = renderer.draw_complete(view_);
    }
    [[nodiscard]] CrackReport with_hole(int x, int y, int width, int height) const {
        ig::Picture holed = sound_;
        punch(holed, x, y, width, height);
        return find_cracks(holed, view_, kLowestHeightM);
    }
    /// The topmost terrain pixel of a column.
    [[nodiscard]] int skyline(int x) const {
        int y = 0;
        while (is_sentinel(sound_, x, y)) ++y;
        return y;
    }

    ig::View view_;
    ig::Picture sound_;
};

TEST_P(CrackSearch, FindsNothingInASoundPicture) {
    EXPECT_EQ(find_cracks(sound_, view_, kLowestHeightM).total(), 0);
}

TEST_P(CrackSearch, FindsASinglePixelAnywhereBelowTheSkyline) {
    for (int x = 5; x < kSmall.width_px - 5; x += 37) {
        for (int y = skyline(x) + 6; y < kSmall.height_px - 1; y += 41)
            EXPECT_GE(with_hole(x, y, 1, 1).total(), 1) << x << " " << y;
    }
}

TEST_P(CrackSearch, FindsALineUnderTheSkyline) {
    for (int x = 20; x < kSmall.width_px - 20; x += 100) {
        const int top = skyline(x);
        if (top > kSmall.height_px - 40) continue;
        EXPECT_GE(with_hole(x, top + 6, 1, 30).total(), 1) << x;
        int lowest = top;
        for (int beside = x; beside < x + 40; ++beside) lowest = std::max(lowest, skyline(beside));
        if (lowest > kSmall.height_px - 10) continue;
        EXPECT_GE(with_hole(x, lowest + 5, 40, 1).total(), 40) << x;
    }
}

/// As a missing block would leave it.
TEST_P(CrackSearch, FindsAHoleOfManyPixels) {
    const int top = skyline(320);
    EXPECT_GE(with_hole(300, top + 20, 40, 25).total(), 25);
}

INSTANTIATE_TEST_SUITE_P(Frames, CrackSearch, ::testing::Values(0U, 700U, 1300U));

}  // namespace
}  // namespace eyepoint::testing
