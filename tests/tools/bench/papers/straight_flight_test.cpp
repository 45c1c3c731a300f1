#include "tools/bench/papers/straight_flight.hpp"

#include <cstdio>
#include <memory>
#include <sstream>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/analytic_terrain.hpp"

namespace eyepoint::tools {
namespace {

using eyepoint::testing::AnalyticPlanet;
using eyepoint::testing::AnalyticTerrain;

struct Fix {
    double time_s = 0.0, latitude_deg = 0.0, longitude_deg = 0.0, altitude_m = 0.0;
};

std::vector<Fix> fixes(const std::string& track) {
    std::istringstream lines(track);
    std::string line;
    std::getline(lines, line);
    std::vector<Fix> result;
    while (std::getline(lines, line)) {
        Fix fix;
        EXPECT_EQ(std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf", &fix.time_s, &fix.latitude_deg,
                              &fix.longitude_deg, &fix.altitude_m),
                  4);
        result.push_back(fix);
    }
    return result;
}

class StraightFlightOver : public ::testing::Test {
  protected:
    static void SetUpTestSuite() {
        planet_ = std::make_unique<AnalyticPlanet>(AnalyticTerrain{.half_size_deg = 0.05});
        database_ = planet_->database();
    }
    static void TearDownTestSuite() {
        database_.reset();
        planet_.reset();
    }

    static inline std::unique_ptr<AnalyticPlanet> planet_;
    static inline std::shared_ptr<const terrain::Database> database_;
};

TEST_F(StraightFlightOver, GoesNorthAtItsSpeedThroughTheMiddleOfTheDetail) {
    const auto track = track_of({.speed_m_s = 100.0, .seconds = 40.0}, database_);
    ASSERT_TRUE(track) << track.error();
    const auto flown = fixes(*track);
    ASSERT_GE(flown.size(), 2U);
    EXPECT_EQ(flown.front().time_s, 0.0);
    EXPECT_EQ(flown.back().time_s, 40.0);
    // A degree of latitude is 111 km to half a percent.
    const double north_deg = flown.back().latitude_deg - flown.front().latitude_deg;
    EXPECT_NEAR(north_deg * 111133.0, 4000.0, 40.0);
    const terrain::GeographicExtent& detail = database_->manifest().detail_extent;
    EXPECT_NEAR(flown.front().latitude_deg + flown.back().latitude_deg, detail.south_deg + detail.north_deg,
                1e-6);
    for (const Fix& fix : flown)
        EXPECT_NEAR(fix.longitude_deg, (detail.west_deg + detail.east_deg) / 2.0, 1e-6);
}

TEST_F(StraightFlightOver, FixesAreSoHighAboveTheGroundThere) {
    const auto track = track_of({.seconds = 20.0, .above_m = 700.0}, database_);
    ASSERT_TRUE(track) << track.error();
    for (const Fix& fix : fixes(*track)) {
        // The database's posts are hills' heights to its height step, and flat between.
        EXPECT_NEAR(
            fix.altitude_m - 700.0,
            eyepoint::testing::analytic_height_m(planet_->terrain(), fix.latitude_deg, fix.longitude_deg),
            20.0);
    }
}

TEST_F(StraightFlightOver, AFlightLongerThanTheDetailIsRefusedInOneSentence) {
    const auto track = track_of({.seconds = 1e5}, database_);
    ASSERT_FALSE(track);
    EXPECT_NE(track.error().find("too small"), std::string::npos);
}

}  // namespace
}  // namespace eyepoint::tools
