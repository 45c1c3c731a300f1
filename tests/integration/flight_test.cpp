/// The whole chain as its users start it: eyepoint-replay sends a part of the sample flight over UDP,
/// eyepoint receives it and draws it, two processes.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <OpenImageIO/imagebuf.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "net/udp_socket.hpp"
#include "tests/support/analytic_terrain.hpp"
#include "tools/process/child_process.hpp"

namespace eyepoint::testing {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using std::chrono::seconds;
using tools::ChildProcess;
using tools::Ending;

constexpr seconds kPatience{120};
constexpr int kWidth = 320, kHeight = 180;
constexpr int kRateHz = 10;
constexpr int kFlownS = 4;
/// The flight's packets in its first four seconds, 30 a second; its README.
constexpr int kPacketsSent = kFlownS * 30;

/// Hills up to about 2,300 m under the flight, which is at 3,050 m.
constexpr AnalyticTerrain kHills{.latitude_deg = 46.42,
                                 .longitude_deg = 8.15,
                                 .half_size_deg = 0.15,
                                 .detail_depth = 9,
                                 .planet_depth = 2,
                                 .amplitude_m = 900.0};

struct Colour {
    double red = 0.0, green = 0.0, blue = 0.0;
};

/// Mean colour of some rows, 0..1.
Colour mean_of_rows(const OIIO::ImageBuf& picture, int first, int last) {
    Colour mean;
    for (int y = first; y < last; ++y) {
        for (int x = 0; x < kWidth; ++x) {
            mean.red += picture.getchannel(x, y, 0, 0);
            mean.green += picture.getchannel(x, y, 0, 1);
            mean.blue += picture.getchannel(x, y, 0, 2);
        }
    }
    const double pixels = static_cast<double>(last - first) * kWidth;
    return {mean.red / pixels, mean.green / pixels, mean.blue / pixels};
}

/// Mean difference of neighbouring pixels in some rows: terrain has relief, a clear sky none.
double roughness(const OIIO::ImageBuf& picture, int first, int last) {
    double sum = 0.0;
    for (int y = first; y < last; ++y) {
        for (int x = 1; x < kWidth; ++x)
            sum += std::abs(picture.getchannel(x, y, 0, 1) - picture.getchannel(x - 1, y, 0, 1));
    }
    return sum / (static_cast<double>(last - first) * (kWidth - 1));
}

/// Share of pixels in which two pictures differ by more than two 8-bit steps of green.
double changed_share(const OIIO::ImageBuf& a, const OIIO::ImageBuf& b) {
    constexpr float kTwoSteps = 2.5F / 255.0F;
    int changed = 0;
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x)
            changed += std::abs(a.getchannel(x, y, 0, 1) - b.getchannel(x, y, 0, 1)) > kTwoSteps ? 1 : 0;
    }
    return static_cast<double>(changed) / (kWidth * kHeight);
}

std::vector<fs::path> files_in(const fs::path& folder) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
    std::ranges::sort(files);
    return files;
}

/// A folder with the pictures and the record of one flight, and what both processes said.
class Flight : public ::testing::Test {
  protected:
    void SetUp() override {
        (void)make_database(kHills, scratch_.path() / "terrain");
        const auto port = std::to_string(net::UdpSocket::bind("127.0.0.1", 0).value().local_port());
        auto eyepoint =
            ChildProcess::start({EYEPOINT_PROGRAM, "--terrain", (scratch_.path() / "terrain").string(),
                                 "--headless", "--output", pictures().string(), "--record", record().string(),
                                 "--size", std::to_string(kWidth) + "x" + std::to_string(kHeight), "--rate",
                                 std::to_string(kRateHz), "--listen", "127.0.0.1", "--port", port,
                                 "--end-after-silence", "1"})
                .value();
        ASSERT_TRUE(eyepoint.wait_for_error_text("ready: listening on 127.0.0.1 port " + port, kPatience))
            << eyepoint.wait(seconds(0)).standard_error;
        auto replay = ChildProcess::start({EYEPOINT_REPLAY_PROGRAM, "play",
                                           EYEPOINT_SOURCE_DIR "/tools/flights/goms-c172-60s-30hz.pcap",
                                           "--to", "127.0.0.1:" + port, "--until", std::to_string(kFlownS)})
                          .value();
        replay_ = replay.wait(kPatience);
        eyepoint_ = eyepoint.wait(kPatience);
    }
    [[nodiscard]] fs::path pictures() const { return scratch_.path() / "pictures"; }
    [[nodiscard]] fs::path record() const { return scratch_.path() / "flight.jsonl"; }
    [[nodiscard]] std::vector<json> record_lines() const {
        std::vector<json> lines;
        std::ifstream stream(record());
        for (std::string text; std::getline(stream, text);) lines.push_back(json::parse(text));
        return lines;
    }
    static OIIO::ImageBuf open(const fs::path& file) {
        OIIO::ImageBuf picture(file.string());
        EXPECT_TRUE(picture.read()) << picture.geterror();
        return picture;
    }

    void expect_good_endings() const;
    void expect_picture_and_record_line_for_every_frame() const;
    void expect_record_to_follow_the_flight() const;
    void expect_sky_above_and_terrain_below() const;
    void expect_change_in_flight_and_stillness_after() const;

    ScratchFolder scratch_;
    Ending replay_, eyepoint_;
};

void Flight::expect_good_endings() const {
    EXPECT_EQ(replay_.exit_code, 0) << replay_.standard_error;
    EXPECT_EQ(eyepoint_.exit_code, 0) << eyepoint_.standard_error;
    EXPECT_EQ(std::ranges::count(eyepoint_.standard_output, '\n'), 1) << eyepoint_.standard_output;
    const auto frames = record_lines().size() - 1;
    EXPECT_EQ(eyepoint_.standard_output.find(std::to_string(frames) + " frames in "), 0U)
        << eyepoint_.standard_output;
    // The flight's packet at 4 s is still within --until 4, or just not.
    const std::string both = replay_.standard_output + eyepoint_.standard_output;
    const bool all = both.find(std::to_string(kPacketsSent) + " packets") != std::string::npos;
    const bool one_more = both.find(std::to_string(kPacketsSent + 1) + " packets") != std::string::npos;
    EXPECT_TRUE(all || one_more) << both;
    EXPECT_EQ(eyepoint_.standard_output.find("dropped"), std::string::npos) << eyepoint_.standard_output;
}

void Flight::expect_picture_and_record_line_for_every_frame() const {
    const auto lines = record_lines();
    ASSERT_GT(lines.size(), 1U);
    const auto files = files_in(pictures());
    ASSERT_EQ(files.size(), lines.size() - 1);
    // Ten a second for four seconds and one of silence; a loaded machine may miss half of the deadlines.
    EXPECT_GE(files.size(), static_cast<std::size_t>(kRateHz * kFlownS / 2));
    EXPECT_LE(files.size(), static_cast<std::size_t>(kRateHz * (kFlownS + 2)));
    for (std::size_t i = 0; i < files.size(); ++i) {
        const auto number = lines[i + 1].at("frame").get<int>();
        EXPECT_EQ(number, static_cast<int>(i) + 1);
        const std::string digits = std::to_string(number);
        EXPECT_EQ(files[i].filename(), "frame-" + std::string(6 - digits.size(), '0') + digits + ".png");
    }
}

void Flight::expect_record_to_follow_the_flight() const {
    auto lines = record_lines();
    ASSERT_GT(lines.size(), 10U);
    EXPECT_EQ(lines[0].at("width_px"), kWidth);
    EXPECT_EQ(lines[0].at("height_px"), kHeight);
    lines.erase(lines.begin());
    for (const json& line : lines) {
        for (const char* key : {"frame", "host_frame", "arrival_to_complete_ms", "cpu_ms", "gpu_ms",
                                "triangles", "draws", "blocks_drawn", "loads_pending", "tau_px"})
            EXPECT_TRUE(line.contains(key)) << key;
        EXPECT_GT(line.at("triangles").get<int>(), 0);
        EXPECT_GT(line.at("arrival_to_complete_ms").get<double>(), 0.0);
        EXPECT_NEAR(line.at("latitude_deg").get<double>(), 46.40, 0.05);
        EXPECT_NEAR(line.at("longitude_deg").get<double>(), 8.13, 0.05);
    }
    const auto host_frame = [](const json& line) { return line.at("host_frame").get<int>(); };
    EXPECT_TRUE(std::ranges::is_sorted(lines, {}, host_frame));
    EXPECT_GE(host_frame(lines.back()), kPacketsSent);
    EXPECT_LE(host_frame(lines.back()), kPacketsSent + 1);
    // A Cessna 172 flies 40 to 70 m/s: 160 to 280 m in the four seconds, less the first packets.
    const double north_m =
        (lines.back()["latitude_deg"].get<double>() - lines[0]["latitude_deg"].get<double>()) * 111.2e3;
    const double east_m =
        (lines.back()["longitude_deg"].get<double>() - lines[0]["longitude_deg"].get<double>()) * 76.8e3;
    EXPECT_GT(std::hypot(north_m, east_m), 80.0);
    EXPECT_LT(std::hypot(north_m, east_m), 300.0);
}

/// The aircraft flies level, 700 m and more above the hills: the horizon is near the picture's middle, the
/// sky above it smooth and bluest, the terrain below it rough and not blue.
void Flight::expect_sky_above_and_terrain_below() const {
    for (const fs::path& file : files_in(pictures())) {
        const OIIO::ImageBuf picture = open(file);
        ASSERT_EQ(picture.spec().width, kWidth);
        ASSERT_EQ(picture.spec().height, kHeight);
        const Colour sky = mean_of_rows(picture, 0, kHeight / 5);
        const Colour ground = mean_of_rows(picture, kHeight * 4 / 5, kHeight);
        EXPECT_GT(sky.blue, sky.red + 0.05) << file;
        EXPECT_GT(sky.blue - sky.green, ground.blue - ground.green + 0.05) << file;
        EXPECT_GT(roughness(picture, kHeight * 4 / 5, kHeight), 2.0 * roughness(picture, 0, kHeight / 5))
            << file;
    }
}

void Flight::expect_change_in_flight_and_stillness_after() const {
    const auto files = files_in(pictures());
    ASSERT_GT(files.size(), 10U);
    EXPECT_GT(changed_share(open(files.front()), open(files.back())), 0.1);
    // After the last packet the eye stands still, and so does the picture.
    EXPECT_EQ(changed_share(open(files[files.size() - 2]), open(files.back())), 0.0);
}

/// One flight of some seconds in real time, so one test.
TEST_F(Flight, OfTheReplayToolIsDrawnByEyepoint) {
    expect_good_endings();
    expect_picture_and_record_line_for_every_frame();
    expect_record_to_follow_the_flight();
    expect_sky_above_and_terrain_below();
    expect_change_in_flight_and_stillness_after();
}

}  // namespace
}  // namespace eyepoint::testing
