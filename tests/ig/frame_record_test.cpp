#include "ig/frame_record.hpp"

#include <filesystem>
#include <fstream>
#include <limits>
#include <set>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace eyepoint::ig {
namespace {

using nlohmann::json;

FrameEntry sample_entry() {
    FrameEntry entry;
    entry.frame = 17;
    entry.host_frame = 4'000'000'001U;
    entry.sim_time_s = 12.25;
    entry.arrival_to_complete_ms = 21.5;
    entry.extrapolated_ms = 30.25;
    entry.gpu_ms = 9.75;
    entry.drawn.triangles = 123'456;
    entry.drawn.triangles_hidden = 40'000;
    entry.drawn.blocks_reused = 321;
    entry.drawn.tau_px = 1.5;
    entry.eye = {46.4, 8.125, terrain::EllipsoidalHeight{3102.5}};
    return entry;
}

TEST(FrameRecordLine, HoldsEveryKeyOfTheFormat) {
    const std::set<std::string> expected{"frame",
                                         "host_frame",
                                         "sim_time_s",
                                         "time_s",
                                         "arrival_to_complete_ms",
                                         "extrapolated_ms",
                                         "new_packet",
                                         "cpu_ms",
                                         "gpu_ms",
                                         "frame_ms",
                                         "frame_thread_cpu_ms",
                                         "output_ms",
                                         "selection_ms",
                                         "triangles",
                                         "draws",
                                         "blocks_drawn",
                                         "triangles_hidden",
                                         "blocks_tested",
                                         "blocks_reused",
                                         "tau_px",
                                         "control",
                                         "unreachable_share",
                                         "loads_pending",
                                         "blocks_uploaded",
                                         "bytes_uploaded",
                                         "latitude_deg",
                                         "longitude_deg",
                                         "missed_deadlines",
                                         "ellipsoidal_height_m"};
    std::set<std::string> found;
    const json line = json::parse(to_json_line(sample_entry()));
    for (const auto& [key, value] : line.items()) found.insert(key);
    EXPECT_EQ(found, expected);
}

TEST(FrameRecordLine, ValuesComeBackAsTheyWere) {
    const json line = json::parse(to_json_line(sample_entry()));
    EXPECT_EQ(line["frame"], 17);
    EXPECT_EQ(line["host_frame"], 4'000'000'001U);
    EXPECT_EQ(line["sim_time_s"], 12.25);
    EXPECT_EQ(line["arrival_to_complete_ms"], 21.5);
    EXPECT_EQ(line["extrapolated_ms"], 30.25);
    EXPECT_EQ(line["gpu_ms"], 9.75);
    EXPECT_EQ(line["triangles"], 123'456);
    EXPECT_EQ(line["triangles_hidden"], 40'000);
    EXPECT_EQ(line["blocks_reused"], 321);
    EXPECT_EQ(line["latitude_deg"], 46.4);
    EXPECT_EQ(line["ellipsoidal_height_m"], 3102.5);
}

TEST(FrameRecordLine, WhatIsNotKnownIsNull) {
    FrameEntry entry = sample_entry();
    entry.sim_time_s.reset();
    entry.gpu_ms.reset();
    entry.cpu_ms = std::numeric_limits<double>::quiet_NaN();
    const json line = json::parse(to_json_line(entry));
    EXPECT_TRUE(line["sim_time_s"].is_null());
    EXPECT_TRUE(line["gpu_ms"].is_null());
    EXPECT_TRUE(line["cpu_ms"].is_null());
}

TEST(FrameRecordHeader, NamesProgramRendererAndTerrain) {
    const RecordHeader header{"1.2.3", {"llvmpipe", "4.5 \"odd\" \xff"}, {1280, 720}, 60.0, "Goms", "tile"};
    const std::string line = to_json_line(header);
    EXPECT_EQ(line.find('\n'), std::string::npos);
    const json parsed = json::parse(line);
    EXPECT_EQ(parsed["version"], "1.2.3");
    EXPECT_EQ(parsed["gl_renderer"], "llvmpipe");
    EXPECT_EQ(parsed["width_px"], 1280);
    EXPECT_EQ(parsed["rate_hz"], 60.0);
    EXPECT_EQ(parsed["terrain"], "Goms");
}

TEST(FrameRecord, LinesStandInTheFileAsSoonAsTheyAreAdded) {
    const auto file = std::filesystem::path(testing::TempDir()) / "record.jsonl";
    auto record = FrameRecord::create(file);
    ASSERT_TRUE(record.has_value()) << record.error();
    ASSERT_TRUE(record->add("{\"a\":1}").has_value());
    ASSERT_TRUE(record->add("{\"b\":2}").has_value());
    std::ifstream stream(file);
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    EXPECT_EQ(text, "{\"a\":1}\n{\"b\":2}\n");
}

TEST(FrameRecord, APlaceThatCannotBeWrittenIsNamedWithTheRemedy) {
    const auto record = FrameRecord::create("/nonexistent/folder/record.jsonl");
    ASSERT_FALSE(record.has_value());
    EXPECT_NE(record.error().find("/nonexistent/folder/record.jsonl"), std::string::npos) << record.error();
    EXPECT_NE(record.error().find("--record"), std::string::npos) << record.error();
}

TEST(FrameRecord, AFullDiskIsAnError) {
    if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
    auto record = FrameRecord::create("/dev/full");
    ASSERT_TRUE(record.has_value()) << record.error();
    EXPECT_FALSE(record->add("{}").has_value());
}

}  // namespace
}  // namespace eyepoint::ig
