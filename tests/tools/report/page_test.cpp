#include "tools/report/page.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/tools/report/scratch_folder.hpp"

namespace eyepoint::tools {
namespace {

using testing::AllOf;
using testing::ContainsRegex;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;

FrameColumns record_of(std::size_t frames) {
    FrameColumns record;
    record.header = {{"gl_renderer", "llvmpipe (LLVM 15)"}};
    record.frames = frames;
    for (std::size_t i = 0; i < frames; ++i) {
        record.columns["frame"].push_back(static_cast<double>(i + 1));
        record.columns["time_s"].push_back(static_cast<double>(i) / 50.0);
        record.columns["frame_ms"].push_back(i == 7 ? 99.25 : 4.0);
        record.columns["missed_deadlines"].push_back(i == 7 ? 4.0 : 0.0);
    }
    return record;
}

std::string page_of(const FrameColumns& record, const std::string& title = "run") {
    const auto page = report_page(title, record, {});
    EXPECT_TRUE(page) << page.error();
    return page.value_or("");
}

TEST(ReportPage, SaysWhatTheRunCameTo) {
    const auto page = page_of(record_of(101));
    EXPECT_THAT(page, AllOf(HasSubstr("<dt>Frames</dt><dd>101</dd>"), HasSubstr("<dd>2.0 s</dd>"),
                            HasSubstr("<dt>Frames a second</dt><dd>50.0</dd>"),
                            HasSubstr("<dt>Missed deadlines</dt><dd>4</dd>"),
                            HasSubstr("<dt>GL renderer</dt><dd>llvmpipe (LLVM 15)</dd>")));
    EXPECT_THAT(page, HasSubstr("Frame time, ms</th><td>4.00</td><td>4.00</td><td>4.00</td><td>99.25</td>"));
}

TEST(ReportPage, IsWholeInItself) {
    const auto page = page_of(record_of(3));
    EXPECT_THAT(page, AllOf(HasSubstr("<!DOCTYPE html>"), EndsWith("</html>\n"), HasSubstr("Chart.js v")));
    EXPECT_THAT(page, Not(HasSubstr("{{title}}")));
    // Nothing is fetched: no source or style sheet but what stands in the page, and the page forbids it too.
    EXPECT_THAT(page, AllOf(Not(ContainsRegex("<script[^>]* src=")), Not(HasSubstr("<link")),
                            Not(HasSubstr("@import")), HasSubstr("default-src 'none'")));
}

TEST(ReportPage, WhatTheRecordSaysCannotBecomeMarkup) {
    auto record = record_of(2);
    record.header.emplace_back("terrain", "<b>&\"");
    record.columns["</script><script>"] = {1.0, 2.0};
    const auto page = page_of(record, "<i>run</i>");
    EXPECT_THAT(
        page, AllOf(HasSubstr("<h1>&lt;i&gt;run&lt;/i&gt;</h1>"), HasSubstr("<dd>&lt;b&gt;&amp;&quot;</dd>"),
                    Not(HasSubstr("</script><script>\""))));
}

TEST(ReportPage, ALongRunIsThinnedWithoutLosingItsSpike) {
    const auto page = page_of(record_of(10000));
    EXPECT_THAT(page, AllOf(HasSubstr("the largest of 4 frames"), HasSubstr("4.0,99.25,4.0")));
}

TEST(ReportPage, OneFrameIsEnough) {
    EXPECT_THAT(page_of(record_of(1)), HasSubstr("<dt>Frames</dt><dd>1</dd>"));
}

TEST(ReportPage, PicturesStandInThePage) {
    const std::vector<SmallPicture> pictures = {
        {.name = "frame-000007", .width_px = 2, .height_px = 2, .rgb = std::vector<std::uint8_t>(12, 90)}};
    const auto page = report_page("run", record_of(2), pictures);
    ASSERT_TRUE(page) << page.error();
    EXPECT_THAT(*page, AllOf(HasSubstr("<img src=\"data:image/jpeg;base64,/9j/"),
                             HasSubstr("<figcaption>frame-000007</figcaption>")));
}

TEST(WriteWhole, ReplacesAFileAndLeavesNothingBeside) {
    const test::ScratchFolder folder;
    const auto file = folder.file("report.html", "old");
    ASSERT_TRUE(write_whole(file, "new"));
    EXPECT_EQ(std::filesystem::file_size(file), 3U);
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
    EXPECT_THAT(write_whole(folder.path() / "none/report.html", "new").error(),
                HasSubstr("cannot be written"));
}

}  // namespace
}  // namespace eyepoint::tools
