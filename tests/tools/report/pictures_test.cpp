#include "tools/report/pictures.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/tools/report/scratch_folder.hpp"
#include "tools/report/contact_sheet.hpp"

namespace eyepoint::tools {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

SmallPicture plain(int width_px, int height_px, std::uint8_t red, std::uint8_t green, std::uint8_t blue) {
    SmallPicture picture{.name = "plain", .width_px = width_px, .height_px = height_px};
    for (int i = 0; i < width_px * height_px; ++i) picture.rgb.insert(picture.rgb.end(), {red, green, blue});
    return picture;
}

std::vector<int> pixel(const SmallPicture& picture, int x, int y) {
    const auto at = static_cast<std::size_t>((y * picture.width_px + x) * 3);
    return {picture.rgb[at], picture.rgb[at + 1], picture.rgb[at + 2]};
}

std::vector<std::string> names(const std::vector<std::filesystem::path>& files) {
    std::vector<std::string> result;
    for (const auto& file : files) result.push_back(file.filename().string());
    return result;
}

TEST(ChoosePictures, TakesTheFirstTheLastAndOthersEvenlyBetween) {
    const test::ScratchFolder folder;
    for (int i = 0; i <= 10; ++i) (void)folder.file(fmt::format("frame-{:06}.png", i), "");
    (void)folder.file("notes.txt", "");
    (void)folder.file(".frame-000011.png.partial", "");
    EXPECT_EQ(names(*choose_pictures(folder.path(), 3)),
              (std::vector<std::string>{"frame-000000.png", "frame-000005.png", "frame-000010.png"}));
    EXPECT_EQ(choose_pictures(folder.path(), 1)->size(), 1U);
    EXPECT_EQ(choose_pictures(folder.path(), 100)->size(), 11U);
}

TEST(ChoosePictures, AFolderThatIsMissingOrHoldsNoneIsRefused) {
    const test::ScratchFolder folder;
    EXPECT_THAT(choose_pictures(folder.path(), 3).error(), HasSubstr("holds no picture"));
    EXPECT_THAT(choose_pictures(folder.path() / "none", 3).error(), HasSubstr("No such file or directory"));
}

TEST(ReadSmall, KeepsColourAndShape) {
    const test::ScratchFolder folder;
    const auto file = folder.path() / "frame-000001.png";
    ASSERT_TRUE(write_picture(file, plain(160, 90, 200, 100, 50)));
    const auto small = read_small(file, 80);
    ASSERT_TRUE(small) << small.error();
    EXPECT_EQ(small->name, "frame-000001");
    EXPECT_EQ(small->width_px, 80);
    EXPECT_EQ(small->height_px, 45);
    EXPECT_EQ(pixel(*small, 40, 20), (std::vector<int>{200, 100, 50}));
}

TEST(ReadSmall, AFileThatIsNoPictureIsRefused) {
    const test::ScratchFolder folder;
    EXPECT_THAT(read_small(folder.file("frame.png", "no picture"), 80).error(), HasSubstr("cannot be read"));
}

TEST(Jpeg, BeginsAndEndsAsJpegFilesDo) {
    const auto bytes = jpeg(plain(32, 16, 10, 20, 30), 80);
    ASSERT_TRUE(bytes) << bytes.error();
    EXPECT_THAT(*bytes, StartsWith("\xFF\xD8\xFF"));
    EXPECT_EQ(bytes->substr(bytes->size() - 2), "\xFF\xD9");
}

TEST(ContactSheet, LaysPicturesOutInRowsFromTheTopLeft) {
    const std::vector<SmallPicture> pictures = {plain(10, 5, 255, 0, 0), plain(10, 5, 0, 255, 0),
                                                plain(10, 5, 0, 0, 255)};
    const auto sheet = lay_out(pictures, 2);
    const int gap = (sheet.width_px - 20) / 3;
    EXPECT_EQ(sheet.height_px, 2 * 5 + 3 * gap);
    EXPECT_EQ(pixel(sheet, gap, gap), (std::vector<int>{255, 0, 0}));
    EXPECT_EQ(pixel(sheet, 2 * gap + 10 + 9, gap + 4), (std::vector<int>{0, 255, 0}));
    EXPECT_EQ(pixel(sheet, gap, 2 * gap + 5), (std::vector<int>{0, 0, 255}));
}

TEST(WritePicture, AFolderThatIsNotThereIsRefusedAndLeavesNothing) {
    const test::ScratchFolder folder;
    const auto written = write_picture(folder.path() / "none/sheet.png", plain(4, 4, 1, 2, 3));
    ASSERT_FALSE(written);
    EXPECT_THAT(written.error(), HasSubstr("sheet.png: picture cannot be written"));
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace
}  // namespace eyepoint::tools
