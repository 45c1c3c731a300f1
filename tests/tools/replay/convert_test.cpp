#include "tools/replay/convert.hpp"

#include <cmath>
#include <fstream>

#include <GeographicLib/Geodesic.hpp>
#include <gtest/gtest.h>

#include "net/pcap_file.hpp"
#include "net/wire/fgnetfdm.hpp"
#include "tests/net/flights.hpp"
#include "tests/net/scratch.hpp"
#include "tools/replay/track_motion.hpp"

namespace eyepoint::tools {
namespace {

using net::testing::Scratch;

// Every B record of the glider's log becomes the packet of the same time, read back from the file that was
// written.
TEST(Convert, AGlidersRealLogIsFlownThroughItsFixes) {
    const char* data = std::getenv("EYEPOINT_REAL_DATA");
    if (data == nullptr || *data == '\0')
        GTEST_SKIP() << "EYEPOINT_REAL_DATA is not set: no glider log to read";
    const auto log = std::filesystem::path(data) / "flights/igc/goms-furka-1s.igc";
    const Scratch scratch;
    constexpr int kRate = 10;
    const auto report =
        convert({.track = log, .output = scratch / "glider.pcap", .sampling = {.rate_hz = kRate}});
    ASSERT_TRUE(report.has_value()) << report.error();
    EXPECT_EQ(report->fixes, 12446U);

    const auto track = read_track(log, IgcAltitude::Automatic);
    const auto recording = net::read_pcap(scratch / "glider.pcap");
    ASSERT_TRUE(track.has_value() && recording.has_value());
    double worst_m = 0.0;
    for (const TrackFix& fix : track->fixes) {
        const auto index = std::lround((fix.time_s - track->fixes.front().time_s) * kRate);
        const auto fdm =
            net::wire::decode_fgnetfdm(recording->datagrams.at(static_cast<std::size_t>(index)).payload);
        ASSERT_TRUE(fdm.has_value());
        double along_m = 0.0;
        GeographicLib::Geodesic::WGS84().Inverse(fdm->latitude_deg, fdm->longitude_deg, fix.latitude_deg,
                                                 fix.longitude_deg, along_m);
        worst_m = std::max(worst_m, std::hypot(along_m, fdm->altitude_m - fix.altitude_m));
    }
    EXPECT_LT(worst_m, 1.0);
    RecordProperty("worst_mm", static_cast<int>(worst_m * 1000.0));

    // A paraglider circles with 20 to 40 degrees of bank; nothing may leave the limits. The log has receiver
    // faults in it, single seconds of more than 200 m; smoothed velocities stay below the fastest of those
    // legs.
    constexpr double kFastestLegMps = 225.0;
    double steepest = 0.0;
    for (std::size_t i = 0; i < recording->datagrams.size(); ++i) {
        const auto fdm = net::wire::decode_fgnetfdm(recording->datagrams[i].payload);
        ASSERT_TRUE(fdm.has_value()) << i;  // finite and in range
        steepest = std::max(steepest, std::abs(fdm->attitude.roll_deg));
        EXPECT_LE(std::abs(fdm->attitude.pitch_deg), kMostPitchDeg + 1e-3);
        for (const double speed : fdm->velocity_ned_mps) EXPECT_LT(std::abs(speed), kFastestLegMps);
    }
    EXPECT_LE(steepest, kMostBankDeg + 1e-3);
    EXPECT_GT(steepest, 20.0);
    EXPECT_EQ(recording->datagrams.front().time_ns, 1566720131LL * 1'000'000'000);  // 2019-08-25 08:02:11 UTC
}

TEST(Convert, FaultsLeaveNothingAndSayWhatToDo) {
    const Scratch scratch;
    std::ofstream(scratch / "good.csv")
        << "time_s,latitude_deg,longitude_deg,altitude_m\n0,46,8,100\n1,46.001,8,100\n";
    const auto output = scratch / "flight.pcap";
    EXPECT_FALSE(convert({.track = scratch / "missing.igc", .output = output}).has_value());
    EXPECT_FALSE(
        convert({.track = scratch / "good.csv", .output = output, .sampling = {.from_s = 5.0}}).has_value());
    const auto too_high =
        convert({.track = scratch / "good.csv", .output = output, .sampling = {.altitude_offset_m = 2.0e6}});
    ASSERT_FALSE(too_high.has_value());
    EXPECT_NE(too_high.error().find("--altitude-offset"), std::string::npos);
    std::ofstream(scratch / "long.csv")
        << "time_s,latitude_deg,longitude_deg,altitude_m\n0,46,8,100\n1e15,46,8,100\n";
    const auto too_long = convert({.track = scratch / "long.csv", .output = output});
    ASSERT_FALSE(too_long.has_value());
    EXPECT_NE(too_long.error().find("--until"), std::string::npos);
    EXPECT_FALSE(std::filesystem::exists(output));
    EXPECT_TRUE(convert({.track = scratch / "good.csv", .output = output}).has_value());
    EXPECT_TRUE(std::filesystem::exists(output));
}

}  // namespace
}  // namespace eyepoint::tools
