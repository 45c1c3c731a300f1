/// The look of the synthetic planet and the sample flight, kept: three pictures against those in
/// tests/picture/golden.
///
/// When a change of the look is meant, look at the new pictures and keep them:
///     EYEPOINT_BLESS=1 ctest --test-dir build/release -R GoldenPicture
/// A picture that differs leaves NAME-expected.png, NAME-got.png and NAME-diff.png (differences times 8) in
/// tests/golden of the build folder.
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <gtest/gtest.h>

#include "tests/picture/flights.hpp"
#include "tests/picture/renderer.hpp"

namespace eyepoint::testing {
namespace {

namespace fs = std::filesystem;

constexpr ig::PictureSize kSize{480, 270};
constexpr double kRateHz = 30.0;
constexpr std::uintmax_t kLargestFileBytes = 200'000;

/// How far two pictures may be apart, in shares of full brightness.
struct Threshold {
    float step = 0.0F;   ///< a pixel differs when a channel is further apart than this
    double share = 0.0;  ///< of the pixels may differ
    double mean = 0.0;   ///< mean difference over all channels
};

constexpr float kEightBitStep = 1.0F / 255.0F;

/// llvmpipe gives the same bits on one machine, run after run. Another CPU compiles the shaders to other
/// vector instructions (with or without fused multiply-add) and another Mesa to other code: colours then move
/// by one 8-bit step where they round differently, and a pixel on the edge between two triangles may take the
/// other one. Nothing else is allowed for: one step anywhere, more at one pixel in a thousand.
constexpr Threshold kLlvmpipe{1.5F * kEightBitStep, 0.001, 0.5 / 255.0};

/// A graphics card interpolates, filters textures and computes powers with other precision than llvmpipe, and
/// breaks ties at triangle edges its own way; the textures' filtering shows most. Four steps anywhere, more
/// on one pixel in fifty: a shift of the picture by half a pixel, or a wrong colour, still fails.
constexpr Threshold kOtherGl{4.5F * kEightBitStep, 0.02, 1.5 / 255.0};

Threshold threshold_for(const ig::GlIdentity& gl) {
    return gl.renderer.find("llvmpipe") != std::string::npos ? kLlvmpipe : kOtherGl;
}

/// A time of the sample flight, or a place of its own.
struct Golden {
    std::string name;
    double flight_time_s = 0.0;
    std::optional<CameraPose> pose;
};

void PrintTo(const Golden& golden, std::ostream* out) { *out << golden.name; }

OIIO::ImageBuf image_of(ig::Picture& picture) {
    const OIIO::ImageSpec spec(picture.size.width_px, picture.size.height_px, 3, OIIO::TypeDesc::UINT8);
    OIIO::ImageBuf image(spec);
    image.set_pixels(OIIO::ROI::All(), OIIO::TypeDesc::UINT8, picture.rgba.data(),
                     ig::Picture::kBytesPerPixel,
                     static_cast<OIIO::stride_t>(picture.size.width_px) * ig::Picture::kBytesPerPixel);
    return image;
}

void leave_for_looking(const OIIO::ImageBuf& expected, const OIIO::ImageBuf& got, const fs::path& stem) {
    fs::create_directories(stem.parent_path());
    constexpr float kAmplified = 8.0F;
    const OIIO::ImageBuf diff =
        OIIO::ImageBufAlgo::mul(OIIO::ImageBufAlgo::absdiff(expected, got), kAmplified);
    expected.write(stem.string() + "-expected.png", OIIO::TypeDesc::UINT8);
    got.write(stem.string() + "-got.png", OIIO::TypeDesc::UINT8);
    diff.write(stem.string() + "-diff.png", OIIO::TypeDesc::UINT8);
}

class GoldenPicture : public ::testing::TestWithParam<Golden> {
  protected:
    GoldenPicture() : renderer_(open_synthetic_terrain(), kSize, {.shading = ig::Shading::Forward}) {}

    [[nodiscard]] ig::Picture draw(const Golden& golden) {
        if (golden.pose) return renderer_.draw_complete(view_of(*golden.pose));
        const auto eyes = eyes_of(sample_flight(), kSize, kRateHz);
        return renderer_.draw_complete(
            eyes.at(static_cast<std::size_t>(golden.flight_time_s * kRateHz)).eyepoint.view);
    }

    Renderer renderer_;
};

TEST_P(GoldenPicture, LooksAsItDid) {
    const fs::path kept = fs::path(EYEPOINT_SOURCE_DIR "/tests/picture/golden") / (GetParam().name + ".png");
    ig::Picture picture = draw(GetParam());
    if (std::getenv("EYEPOINT_BLESS") != nullptr) {
        write_png(picture, kept.string());
        EXPECT_LE(fs::file_size(kept), kLargestFileBytes) << kept;
        GTEST_SKIP() << "kept as " << kept;
    }
    const OIIO::ImageBuf got = image_of(picture);
    OIIO::ImageBuf expected(kept.string());
    ASSERT_TRUE(expected.init_spec(kept.string(), 0, 0)) << expected.geterror();
    const Threshold threshold = threshold_for(renderer_.gl());
    const auto result = OIIO::ImageBufAlgo::compare(expected, got, threshold.step, threshold.step);
    const double differing = static_cast<double>(result.nfail) / (kSize.width_px * kSize.height_px);
    const bool alike = !result.error && differing <= threshold.share && result.meanerror <= threshold.mean;
    if (alike) return;
    const fs::path stem = fs::path(EYEPOINT_BINARY_DIR "/tests/golden") / GetParam().name;
    leave_for_looking(expected, got, stem);
    ADD_FAILURE() << GetParam().name << " on " << renderer_.gl().renderer << ": " << differing * 100.0
                  << "% of the pixels differ by more than " << threshold.step * 255.0F << " steps (allowed "
                  << threshold.share * 100.0 << "%), the mean is " << result.meanerror * 255.0
                  << " steps (allowed " << threshold.mean * 255.0 << "), the worst pixel, "
                  << result.maxerror * 255.0 << " steps, is " << result.maxx << " " << result.maxy << ". See "
                  << stem.string() << "-{expected,got,diff}.png";
}

TEST_P(GoldenPicture, IsTheSameBitsWhenDrawnAgain) {
    const ig::Picture first = draw(GetParam());
    EXPECT_EQ(first.rgba, draw(GetParam()).rgba);
}

/// Over the coast in the south-west of the synthetic region, looking out to sea, banked to the left.
const CameraPose kCoast{.place = {46.04, 8.03, 1500.0},
                        .yaw_deg = 205.0,
                        .pitch_deg = -14.0,
                        .roll_deg = -12.0,
                        .width_px = kSize.width_px,
                        .height_px = kSize.height_px};

INSTANTIATE_TEST_SUITE_P(SampleFlight, GoldenPicture,
                         ::testing::Values(Golden{"level", 3.0, {}}, Golden{"banked", 45.0, {}},
                                           Golden{"coast", 0.0, kCoast}),
                         [](const auto& instance) { return instance.param.name; });

}  // namespace
}  // namespace eyepoint::testing
