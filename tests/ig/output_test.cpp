#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "ig/output/picture_folder.hpp"
#include "ig/output/video_pipe.hpp"
#include "ig/signals.hpp"

namespace eyepoint::ig {
namespace {

namespace fs = std::filesystem;

fs::path fresh_folder() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    const fs::path folder = fs::path(testing::TempDir()) / (std::string("eyepoint-output-") + test->name());
    fs::remove_all(folder);
    fs::create_directories(folder);
    return folder;
}

/// Red grows to the right, green downwards.
Picture gradient(PictureSize size) {
    Picture picture{size, {}};
    for (int y = 0; y < size.height_px; ++y) {
        for (int x = 0; x < size.width_px; ++x) {
            for (const int value : {x * 10, y * 10, 77, 0})
                picture.rgba.push_back(static_cast<std::uint8_t>(value));
        }
    }
    return picture;
}

std::size_t files_in(const fs::path& folder) {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

bool have_ffmpeg() { return std::system("ffmpeg -version >/dev/null 2>&1") == 0; }

/// What ffprobe says of the first video stream.
std::string probe(const fs::path& video, const std::string& entry) {
    const std::string command =
        "ffprobe -v error -count_frames -select_streams v:0 -show_entries stream=" + entry +
        " -of csv=p=0 '" + video.string() + "'";
    std::string text;
    FILE* pipe = popen(command.c_str(), "r");
    for (int c = std::fgetc(pipe); c != EOF && c != '\n'; c = std::fgetc(pipe)) text += static_cast<char>(c);
    pclose(pipe);
    return text;
}

TEST(PictureFolder, WritesANumberedPngWithTheRowsFromTheTop) {
    const fs::path folder = fresh_folder() / "made" / "here";
    const auto pictures = PictureFolder::open(folder);
    ASSERT_TRUE(pictures.has_value()) << pictures.error();
    const auto written = pictures->write(gradient({20, 10}), 123);
    ASSERT_TRUE(written.has_value()) << written.error();
    EXPECT_EQ(files_in(folder), 1U);

    const auto png = OIIO::ImageInput::open((folder / "frame-000123.png").string());
    ASSERT_NE(png, nullptr);
    ASSERT_EQ(png->spec().width, 20);
    ASSERT_EQ(png->spec().height, 10);
    ASSERT_EQ(png->spec().nchannels, 3);
    std::vector<std::uint8_t> rgb(20 * 10 * 3);
    ASSERT_TRUE(png->read_image(0, 0, 0, 3, OIIO::TypeDesc::UINT8, rgb.data()));
    const std::size_t fourth_row_eighth_pixel = (3 * 20 + 7) * 3;
    EXPECT_EQ(rgb[fourth_row_eighth_pixel], 70);
    EXPECT_EQ(rgb[fourth_row_eighth_pixel + 1], 30);
    EXPECT_EQ(rgb[fourth_row_eighth_pixel + 2], 77);
}

TEST(PictureFolder, APlaceThatIsAFileIsRefusedBeforeAnyPicture) {
    const fs::path file = fresh_folder() / "file";
    std::ofstream(file) << "x";
    const auto pictures = PictureFolder::open(file);
    ASSERT_FALSE(pictures.has_value());
    EXPECT_NE(pictures.error().find(file.string()), std::string::npos) << pictures.error();
    EXPECT_NE(pictures.error().find("--output"), std::string::npos) << pictures.error();
}

TEST(PictureFolder, AFolderWithoutWritePermissionIsRefused) {
    if (geteuid() == 0) GTEST_SKIP() << "root may write anywhere";
    const fs::path folder = fresh_folder() / "locked";
    fs::create_directory(folder);
    fs::permissions(folder, fs::perms::owner_read | fs::perms::owner_exec);
    EXPECT_FALSE(PictureFolder::open(folder).has_value());
}

TEST(PictureFolder, AFailedWriteLeavesNothing) {
    const fs::path folder = fresh_folder();
    const auto pictures = PictureFolder::open(folder);
    ASSERT_TRUE(pictures.has_value());
    fs::create_directory(folder / "frame-000001.png");  // the rename cannot succeed
    EXPECT_FALSE(pictures->write(gradient({4, 4}), 1).has_value());
    EXPECT_EQ(files_in(folder), 1U);
}

TEST(VideoPipe, MakesAnH264FileOfTheFramesWritten) {
    if (!have_ffmpeg()) GTEST_SKIP() << "ffmpeg is not installed";
    const StopSignals signals;
    const fs::path folder = fresh_folder();
    auto video = VideoPipe::start({.file = folder / "flight.mp4", .size = {32, 18}, .rate_hz = 25.0});
    ASSERT_TRUE(video.has_value()) << video.error();
    for (std::uint64_t slot = 7; slot < 57; ++slot)
        ASSERT_TRUE(video->write(gradient({32, 18}), slot).has_value());
    const auto finished = video->finish();
    ASSERT_TRUE(finished.has_value()) << finished.error();
    EXPECT_EQ(files_in(folder), 1U);
    EXPECT_EQ(probe(folder / "flight.mp4", "codec_name,pix_fmt"), "h264,yuv420p");
    EXPECT_EQ(probe(folder / "flight.mp4", "nb_read_frames"), "50");
    EXPECT_EQ(probe(folder / "flight.mp4", "r_frame_rate"), "25/1");
}

TEST(VideoPipe, TheSlotsThatALateFrameMissedShowTheOneBeforeIt) {
    if (!have_ffmpeg()) GTEST_SKIP() << "ffmpeg is not installed";
    const StopSignals signals;
    const fs::path file = fresh_folder() / "late.mp4";
    auto video = VideoPipe::start({.file = file, .size = {32, 18}, .rate_hz = 59.94});
    ASSERT_TRUE(video.has_value()) << video.error();
    for (const std::uint64_t slot : {100U, 101U, 130U, 159U}) {
        ASSERT_TRUE(video->write(gradient({32, 18}), slot).has_value());
    }
    ASSERT_TRUE(video->finish().has_value());
    EXPECT_EQ(probe(file, "nb_read_frames"), "60");
    EXPECT_EQ(probe(file, "r_frame_rate"), "2997/50");
}

TEST(VideoPipe, OddSidesArePaddedToEvenOnes) {
    if (!have_ffmpeg()) GTEST_SKIP() << "ffmpeg is not installed";
    const StopSignals signals;
    const fs::path file = fresh_folder() / "odd.mp4";
    auto video = VideoPipe::start({.file = file, .size = {33, 19}, .rate_hz = 30.0});
    ASSERT_TRUE(video.has_value()) << video.error();
    ASSERT_TRUE(video->write(gradient({33, 19}), 0).has_value());
    ASSERT_TRUE(video->finish().has_value());
    EXPECT_EQ(probe(file, "width,height"), "34,20");
}

TEST(VideoPipe, WithoutFinishNothingIsLeft) {
    if (!have_ffmpeg()) GTEST_SKIP() << "ffmpeg is not installed";
    const StopSignals signals;
    const fs::path folder = fresh_folder();
    {
        auto video = VideoPipe::start({.file = folder / "cut.mp4", .size = {32, 18}});
        ASSERT_TRUE(video.has_value()) << video.error();
        ASSERT_TRUE(video->write(gradient({32, 18}), 0).has_value());
    }
    EXPECT_EQ(files_in(folder), 0U);
}

TEST(VideoPipe, AMissingProgramIsNamedWithTheRemedyAndLeavesNothing) {
    const fs::path folder = fresh_folder();
    const auto video = VideoPipe::start(
        {.file = folder / "a.mp4", .size = {32, 18}, .rate_hz = 30.0, .program = "no-such-ffmpeg"});
    ASSERT_FALSE(video.has_value());
    EXPECT_NE(video.error().find("no-such-ffmpeg"), std::string::npos) << video.error();
    EXPECT_NE(video.error().find("install"), std::string::npos) << video.error();
    EXPECT_EQ(files_in(folder), 0U);
}

TEST(VideoPipe, APlaceThatCannotBeWrittenIsRefused) {
    const auto video = VideoPipe::start({.file = "/nonexistent/folder/a.mp4", .size = {32, 18}});
    ASSERT_FALSE(video.has_value());
    EXPECT_NE(video.error().find("--video"), std::string::npos) << video.error();
}

TEST(VideoPipe, AChildThatDiesIsAnErrorAndNotASignal) {
    const StopSignals signals;
    auto video = VideoPipe::start(
        {.file = fresh_folder() / "a.mp4", .size = {640, 480}, .rate_hz = 30.0, .program = "false"});
    ASSERT_TRUE(video.has_value()) << video.error();
    tl::expected<void, std::string> written;
    for (std::uint64_t slot = 0; slot < 100 && written; ++slot)
        written = video->write(gradient({640, 480}), slot);
    ASSERT_FALSE(written.has_value());
    EXPECT_NE(written.error().find("status 1"), std::string::npos) << written.error();
}

TEST(VideoPipe, AFrameOfAnotherSizeIsRefused) {
    const StopSignals signals;
    auto video = VideoPipe::start(
        {.file = fresh_folder() / "a.mp4", .size = {32, 18}, .rate_hz = 30.0, .program = "cat"});
    ASSERT_TRUE(video.has_value()) << video.error();
    EXPECT_FALSE(video->write(gradient({16, 18}), 0).has_value());
}

}  // namespace
}  // namespace eyepoint::ig
