#include "tools/report/frame_columns.hpp"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/tools/report/scratch_folder.hpp"

namespace eyepoint::tools {
namespace {

using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::IsNan;
using testing::Not;

class FrameColumnsTest : public testing::Test {
  protected:
    [[nodiscard]] auto read(const std::string& content) const {
        return read_frame_columns(folder_.file("run.jsonl", content));
    }
    test::ScratchFolder folder_;
};

TEST_F(FrameColumnsTest, TheHeaderAndAColumnOfEveryNumberAreRead) {
    const auto record = read(
        "{\"rate_hz\":30.0,\"gl_renderer\":\"llvmpipe\"}\n{\"frame\":1,\"frame_ms\":4.5}\n{\"frame\":2,"
        "\"frame_ms\":5}\n");
    ASSERT_TRUE(record) << record.error();
    EXPECT_EQ(record->header, (RecordHeader{{"rate_hz", "30.0"}, {"gl_renderer", "llvmpipe"}}));
    EXPECT_EQ(record->frames, 2U);
    EXPECT_THAT(*record->find("frame_ms"), ElementsAre(4.5, 5.0));
    EXPECT_EQ(record->find("triangles"), nullptr);
    EXPECT_FALSE(record->cut_off);
}

TEST_F(FrameColumnsTest, WhatAFrameDoesNotSayIsAbsentThere) {
    const auto record = read("{\"frame\":1,\"gpu_ms\":null}\n{\"frame\":2,\"gpu_ms\":3}\n{\"frame\":3}\n");
    ASSERT_TRUE(record) << record.error();
    EXPECT_THAT(*record->find("gpu_ms"), ElementsAre(IsNan(), 3.0, IsNan()));
}

TEST_F(FrameColumnsTest, TransportDelayCountsOnlyTheFirstFrameOfAPacket) {
    const auto record = read(
        "{\"frame\":1,\"arrival_to_complete_ms\":8,\"new_packet\":true}\n"
        "{\"frame\":2,\"arrival_to_complete_ms\":24,\"new_packet\":false}\n");
    ASSERT_TRUE(record) << record.error();
    EXPECT_THAT(*record->find("transport_delay_ms"), ElementsAre(8.0, IsNan()));
    EXPECT_THAT(*record->find("arrival_to_complete_ms"), ElementsAre(8.0, 24.0));
}

TEST_F(FrameColumnsTest, ALastLineThatWasCutOffIsLeftOutAndSaid) {
    const auto record = read("{\"frame\":1}\n{\"frame\":2}\n{\"frame\":3,\"tria");
    ASSERT_TRUE(record) << record.error();
    EXPECT_EQ(record->frames, 2U);
    EXPECT_TRUE(record->cut_off);
}

TEST_F(FrameColumnsTest, ABrokenLineIsNamed) {
    for (const auto* broken : {"{\"frame\":2,\n", "frame 2\n", "[1]\n", "{\"frames\":2}\n", "\n"}) {
        const auto record = read(std::string("{\"frame\":1}\n") + broken + "{\"frame\":3}\n");
        ASSERT_FALSE(record) << broken;
        EXPECT_THAT(record.error(), HasSubstr("run.jsonl:2: not a line of a frame record"));
        EXPECT_THAT(record.error(), Not(HasSubstr("\n")));
    }
}

TEST_F(FrameColumnsTest, ARecordWithoutAFrameIsRefused) {
    for (const auto* empty : {"", "{\"gl_renderer\":\"llvmpipe\"}\n"}) {
        const auto record = read(empty);
        ASSERT_FALSE(record);
        EXPECT_THAT(record.error(), HasSubstr("holds no frame"));
    }
}

TEST_F(FrameColumnsTest, AMissingFileAndAFolderAreRefused) {
    EXPECT_THAT(read_frame_columns(folder_.path() / "none.jsonl").error(),
                EndsWith("No such file or directory"));
    EXPECT_THAT(read_frame_columns(folder_.path()).error(), EndsWith("it is a folder"));
}

}  // namespace
}  // namespace eyepoint::tools
