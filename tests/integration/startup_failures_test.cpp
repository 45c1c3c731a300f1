/// Whatever keeps `eyepoint` from starting is told in one line with the remedy, exit code 1, before any
/// frame.
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "net/udp_socket.hpp"
#include "tests/support/analytic_terrain.hpp"
#include "tools/process/child_process.hpp"

namespace eyepoint::testing {
namespace {

namespace fs = std::filesystem;
using tools::ChildProcess;
using tools::Ending;
using Environment = std::vector<std::pair<std::string, std::string>>;
using std::chrono::seconds;

/// A bare ellipsoid: the smallest database there is.
constexpr AnalyticTerrain kBareEarth{
    .half_size_deg = 0.01, .detail_depth = 1, .planet_depth = 0, .amplitude_m = 0.0};

class StartupFailure : public ::testing::Test {
  protected:
    StartupFailure() : terrain_(scratch_.path() / "terrain") { (void)make_database(kBareEarth, terrain_); }

    [[nodiscard]] Ending run(std::vector<std::string> arguments, const Environment& environment = {}) const {
        arguments.insert(arguments.begin(), EYEPOINT_PROGRAM);
        return ChildProcess::start(arguments, environment).value().wait(seconds(60));
    }

    /// With all that a start needs, and a port that is free.
    [[nodiscard]] Ending run_with_terrain(std::vector<std::string> arguments,
                                          const Environment& environment = {}) const {
        const auto port = net::UdpSocket::bind("127.0.0.1", 0).value().local_port();
        const std::vector<std::string> needed{"--terrain", terrain_.string(), "--headless",
                                              "--size",    "64x48",           "--listen",
                                              "127.0.0.1", "--port",          std::to_string(port)};
        arguments.insert(arguments.begin(), needed.begin(), needed.end());
        return run(arguments, environment);
    }

    static void expect_one_line_with(const Ending& ending, const std::vector<std::string>& parts) {
        ASSERT_TRUE(ending.exit_code.has_value()) << "ended by a signal: " << ending.standard_error;
        EXPECT_EQ(*ending.exit_code, 1) << ending.standard_error;
        EXPECT_EQ(std::ranges::count(ending.standard_error, '\n'), 1) << ending.standard_error;
        EXPECT_EQ(ending.standard_output, "");
        for (const std::string& part : parts) {
            EXPECT_NE(ending.standard_error.find(part), std::string::npos)
                << "'" << part << "' is not in: " << ending.standard_error;
        }
    }

    ScratchFolder scratch_;
    fs::path terrain_;
};

TEST_F(StartupFailure, NoTerrain) {
    expect_one_line_with(run({"--headless"}), {"--terrain", "eyepoint-terrain"});
}

TEST_F(StartupFailure, TerrainThatIsNotThere) {
    const std::string folder = (scratch_.path() / "nowhere").string();
    expect_one_line_with(run({"--headless", "--terrain", folder}), {folder, "eyepoint-terrain"});
}

TEST_F(StartupFailure, TerrainThatIsCutShort) {
    for (const auto& entry : fs::recursive_directory_iterator(terrain_)) {
        if (entry.is_regular_file() && entry.file_size() > 100) fs::resize_file(entry, entry.file_size() / 2);
    }
    expect_one_line_with(run_with_terrain({}), {terrain_.string()});
}

TEST_F(StartupFailure, ConfigurationThatIsNotThere) {
    expect_one_line_with(run({"--config", "/nonexistent.toml"}), {"/nonexistent.toml"});
}

TEST_F(StartupFailure, ConfigurationWithAMistypedKey) {
    const fs::path file = scratch_.path() / "mistyped.toml";
    std::ofstream(file) << "[view]\nwidht_px = 640\n";
    expect_one_line_with(run({"--config", file.string()}), {"mistyped.toml:2", "widht_px", "width_px"});
}

TEST_F(StartupFailure, AFlagThatDoesNotExist) {
    expect_one_line_with(run({"--hedless"}), {"--hedless", "--help"});
}

TEST_F(StartupFailure, AValueOutOfRange) {
    expect_one_line_with(run_with_terrain({"--rate", "0"}), {"--rate", "1"});
}

TEST_F(StartupFailure, APortInUse) {
    const auto taken = net::UdpSocket::bind("127.0.0.1", 0);
    ASSERT_TRUE(taken.has_value()) << taken.error();
    const std::string port = std::to_string(taken->local_port());
    expect_one_line_with(run_with_terrain({"--port", port}), {port, "port"});
}

TEST_F(StartupFailure, AnAddressOfAnotherMachine) {
    expect_one_line_with(run_with_terrain({"--listen", "192.0.2.1"}), {"192.0.2.1"});
}

TEST_F(StartupFailure, APictureFolderThatIsAFile) {
    const fs::path file = scratch_.path() / "file";
    std::ofstream(file) << "x";
    expect_one_line_with(run_with_terrain({"--output", file.string()}), {file.string(), "--output"});
}

TEST_F(StartupFailure, AVideoInAFolderThatIsNotThere) {
    expect_one_line_with(run_with_terrain({"--video", "/nonexistent/a.mp4"}),
                         {"/nonexistent/a.mp4", "--video"});
}

TEST_F(StartupFailure, ARecordInAFolderThatIsNotThere) {
    expect_one_line_with(run_with_terrain({"--record", "/nonexistent/a.jsonl"}),
                         {"/nonexistent/a.jsonl", "--record"});
}

TEST_F(StartupFailure, ATraceInAFolderThatIsNotThere) {
    expect_one_line_with(run_with_terrain({"--trace", "/nonexistent/a.json"}),
                         {"/nonexistent/a.json", "--trace"});
}

TEST_F(StartupFailure, NoFfmpeg) {
    const fs::path video = scratch_.path() / "a.mp4";
    const Ending ending = run_with_terrain({"--video", video.string()}, {{"PATH", "/nonexistent"}});
    expect_one_line_with(ending, {"ffmpeg", "install"});
    EXPECT_TRUE(fs::is_directory(scratch_.path()));
    EXPECT_FALSE(fs::exists(video));
}

TEST_F(StartupFailure, AGeoidThatIsNotThere) {
    expect_one_line_with(run_with_terrain({"--set", "terrain.geoid=/nonexistent.pgm"}), {"/nonexistent.pgm"});
}

TEST_F(StartupFailure, AnUnknownLodMethod) {
    expect_one_line_with(run_with_terrain({"--set", "lod.method=magic"}), {"magic"});
}

TEST_F(StartupFailure, NoDisplayForAWindow) {
    const auto port = net::UdpSocket::bind("127.0.0.1", 0).value().local_port();
    const Ending ending = run({"--terrain", terrain_.string(), "--window", "--port", std::to_string(port)},
                              {{"DISPLAY", ""}, {"WAYLAND_DISPLAY", ""}});
    expect_one_line_with(ending, {"display", "--headless"});
}

TEST_F(StartupFailure, NoEglDriver) {
    expect_one_line_with(run_with_terrain({}, {{"__EGL_VENDOR_LIBRARY_FILENAMES", "/nonexistent.json"}}),
                         {"EGL", "libegl-mesa0"});
}

TEST_F(StartupFailure, AnOldOpenGl) {
    expect_one_line_with(
        run_with_terrain({}, {{"MESA_GL_VERSION_OVERRIDE", "3.3"}, {"LIBGL_ALWAYS_SOFTWARE", "1"}}),
        {"OpenGL 3.3", "4.5", "driver"});
}

TEST_F(StartupFailure, NoClipControl) {
    const Environment without{{"MESA_EXTENSION_OVERRIDE", "-GL_ARB_clip_control"},
                              {"LIBGL_ALWAYS_SOFTWARE", "1"}};
    expect_one_line_with(run_with_terrain({}, without), {"GL_ARB_clip_control", "driver"});
}

TEST_F(StartupFailure, ToleranceBoundsTheWrongWayRoundAreNamed) {
    expect_one_line_with(run_with_terrain({"--set", "control.tolerance=on", "--set", "control.tau_min_px=8",
                                           "--set", "control.tau_max_px=4"}),
                         {"control.tau_min_px is 8", "control.tau_max_px is 4"});
}

}  // namespace
}  // namespace eyepoint::testing
