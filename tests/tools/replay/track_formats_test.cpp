#include <fstream>

#include <gtest/gtest.h>

#include "tests/net/scratch.hpp"
#include "tools/replay/track.hpp"

namespace eyepoint::tools {
namespace {

// Built by hand from the IGC specification: 23:59:58 and 00:00:01 UTC, 33 S 70 W, extra digits of the minutes
// at the end.
constexpr std::string_view kMidnightIgc =
    "AXXX001\r\n"
    "HFDTEDATE:310519,01\r\n"
    "I023636LAD3737LOD\r\n"
    "B2359583330500S07015250WA012340130000\r\n"
    "B2359593330500S07015250WA012340130055\r\n"
    "B2359593330500S07015250WA012340130055\r\n"
    "B0000013330501S07015250WA012350130100\r\n"
    "LXXX a comment\r\n"
    "B000002 broken\r\n";

TEST(Igc, ReadsFixesAcrossMidnight) {
    const auto track = parse_igc(kMidnightIgc, IgcAltitude::Automatic);
    ASSERT_TRUE(track.has_value()) << track.error();
    ASSERT_EQ(track->fixes.size(), 3U);
    EXPECT_EQ(track->skipped, 2U);              // one repeated, one broken
    EXPECT_EQ(track->start_utc_s, 1559260800);  // date -d '2019-05-31 UTC' +%s
    EXPECT_EQ(track->fixes[0].time_s, 86398.0);
    EXPECT_EQ(track->fixes[2].time_s, 86401.0);
    EXPECT_NEAR(track->fixes[0].latitude_deg, -(33.0 + 30.5 / 60.0), 1e-12);
    EXPECT_NEAR(track->fixes[0].longitude_deg, -(70.0 + 15.25 / 60.0), 1e-12);
    EXPECT_NEAR(track->fixes[1].latitude_deg, -(33.0 + 30.5005 / 60.0), 1e-12);  // with the digit of LAD
    EXPECT_EQ(track->fixes[0].altitude_m, 1300.0);
    EXPECT_EQ(track->altitude_source, "GNSS altitude");
}

TEST(Igc, ThePressureAltitudeIsTakenWhereAskedOrAlone) {
    const auto asked = parse_igc(kMidnightIgc, IgcAltitude::Pressure);
    ASSERT_TRUE(asked.has_value());
    EXPECT_EQ(asked->fixes[0].altitude_m, 1234.0);
    const auto alone = parse_igc("B1000004600000N00800000EA0100000000\nB1000014600010N00800000EA0100100000\n",
                                 IgcAltitude::Automatic);
    ASSERT_TRUE(alone.has_value());
    EXPECT_EQ(alone->altitude_source, "pressure altitude");
    EXPECT_EQ(alone->fixes[1].altitude_m, 1001.0);
    EXPECT_FALSE(alone->start_utc_s.has_value());
}

TEST(Igc, AFixWithoutAltitudeAmongOthersIsAHole) {
    const auto track = parse_igc(
        "B1000004600000N00800000EA0100001050\nB1000014600010N00800000EV0100000000\nB1000024600020N00800000EA0"
        "100001052\n",
        IgcAltitude::Automatic);
    ASSERT_TRUE(track.has_value());
    EXPECT_EQ(track->fixes.size(), 2U);
    EXPECT_EQ(track->skipped, 1U);
}

TEST(Gpx, ReadsTrackPointsOfAllSegments) {
    const auto track = parse_gpx(R"(<?xml version="1.0"?>
<gpx version="1.1" xmlns="http://www.topografix.com/GPX/1/1"><metadata/><trk><trkseg>
<trkpt lat="46.5" lon="8.25"><ele>1500.5</ele><time>2019-08-25T08:02:11Z</time></trkpt>
<trkpt lat="46.6" lon="8.25"><time>2019-08-25T08:02:12Z</time></trkpt>
</trkseg><trkseg>
<trkpt lat="46.7" lon="8.26"><ele> 1502 </ele><time>2019-08-25T10:02:13.5+02:00</time></trkpt>
</trkseg></trk></gpx>)");
    ASSERT_TRUE(track.has_value()) << track.error();
    ASSERT_EQ(track->fixes.size(), 2U);
    EXPECT_EQ(track->skipped, 1U);              // the one without an elevation
    EXPECT_EQ(track->start_utc_s, 1566720131);  // date -d '2019-08-25 08:02:11 UTC' +%s
    EXPECT_EQ(track->fixes[0].time_s, 0.0);
    EXPECT_EQ(track->fixes[1].time_s, 2.5);
    EXPECT_EQ(track->fixes[1].latitude_deg, 46.7);
    EXPECT_EQ(track->fixes[1].altitude_m, 1502.0);
}

TEST(Gpx, ADateThatNoFlightHasIsForgotten) {
    for (const char* year : {"0001", "9999"}) {
        const auto track =
            parse_gpx(std::string("<gpx><trk><trkseg>"
                                  "<trkpt lat='46' lon='8'><ele>1</ele><time>") +
                      year + "-01-01T00:00:00Z</time></trkpt><trkpt lat='46' lon='8'><ele>1</ele><time>" +
                      year + "-01-01T00:00:05Z</time></trkpt></trkseg></trk></gpx>");
        ASSERT_TRUE(track.has_value()) << track.error();
        EXPECT_FALSE(track->start_utc_s.has_value());
        EXPECT_EQ(track->fixes[1].time_s, 5.0);
    }
}

TEST(Gpx, WhatIsNotXmlIsRefused) {
    EXPECT_FALSE(parse_gpx("<gpx><trk>").has_value());
    EXPECT_FALSE(parse_gpx("not xml").has_value());
    EXPECT_FALSE(parse_gpx("<gpx/>").has_value());
}

TEST(Csv, ReadsColumnsInAnyOrder) {
    const auto track = parse_csv(
        "altitude_m,speed,time_s, latitude_deg,longitude_deg\r\n"
        "100,7,0.0,46.5,8.25\r\n\r\n101,7,0.5,46.6,8.26\r\nx,7,1,46.6,8.26\r\n");
    ASSERT_TRUE(track.has_value()) << track.error();
    ASSERT_EQ(track->fixes.size(), 2U);
    EXPECT_EQ(track->skipped, 1U);
    EXPECT_EQ(track->fixes[1].time_s, 0.5);
    EXPECT_EQ(track->fixes[1].latitude_deg, 46.6);
    EXPECT_EQ(track->fixes[1].altitude_m, 101.0);
    EXPECT_FALSE(track->fixes[1].attitude.has_value());
}

TEST(Csv, ReadsAttitudes) {
    const auto track = parse_csv(
        "time_s,latitude_deg,longitude_deg,altitude_m,yaw_deg,pitch_deg,roll_deg\n"
        "0,46,8,100,350,5,-10\n1,46,8,100,10,6,-11\n");
    ASSERT_TRUE(track.has_value());
    EXPECT_EQ(track->fixes[0].attitude->yaw_deg, 350.0);
    EXPECT_EQ(track->fixes[0].attitude->roll_deg, -10.0);
}

TEST(Csv, AHeaderThatLacksAColumnIsNamed) {
    const auto missing = parse_csv("time_s,latitude_deg,longitude_deg\n0,46,8\n1,46,8\n");
    ASSERT_FALSE(missing.has_value());
    EXPECT_NE(missing.error().find("altitude_m"), std::string::npos);
    const auto some =
        parse_csv("time_s,latitude_deg,longitude_deg,altitude_m,yaw_deg\n0,46,8,1,2\n1,46,8,1,2\n");
    ASSERT_FALSE(some.has_value());
    EXPECT_NE(some.error().find("roll_deg"), std::string::npos);
}

TEST(Track, FixesThatAreNowhereAreSkipped) {
    const auto track = parse_csv(
        "time_s,latitude_deg,longitude_deg,altitude_m\n"
        "0,46,8,100\n1,nan,8,100\n2,91,8,100\n3,46,8,1e9\n4,46,inf,100\n2,46,8,100\n5,46,8,100\n4,46,8,1\n");
    ASSERT_TRUE(track.has_value()) << track.error();
    ASSERT_EQ(track->fixes.size(), 3U);  // at 0, 2 and 5 s
    EXPECT_EQ(track->skipped, 5U);
}

TEST(Track, OneFixIsNoTrack) {
    const auto track = parse_csv("time_s,latitude_deg,longitude_deg,altitude_m\n0,46,8,100\n");
    ASSERT_FALSE(track.has_value());
    EXPECT_NE(track.error().find("two"), std::string::npos);
}

TEST(Track, FilesAreToldByTheirEnding) {
    const net::testing::Scratch scratch;
    std::ofstream(scratch / "a.CSV")
        << "time_s,latitude_deg,longitude_deg,altitude_m\n0,46,8,100\n1,46,8,100\n";
    EXPECT_TRUE(read_track(scratch / "a.CSV", IgcAltitude::Automatic).has_value());
    std::ofstream(scratch / "a.kml") << "<kml/>";
    for (const char* name : {"a.kml", "missing.igc"}) {
        const auto track = read_track(scratch / name, IgcAltitude::Automatic);
        ASSERT_FALSE(track.has_value());
        EXPECT_NE(track.error().find(name), std::string::npos);
    }
}

}  // namespace
}  // namespace eyepoint::tools
