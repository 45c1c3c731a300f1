#include "tools/replay/track_curve.hpp"

#include <cmath>

#include <GeographicLib/Geodesic.hpp>
#include <gtest/gtest.h>

namespace eyepoint::tools {
namespace {

Track track_of(std::vector<TrackFix> fixes) {
    Track track;
    track.fixes = std::move(fixes);
    return track;
}

double metres_between(const TrackCurve::Place& place, const TrackFix& fix) {
    double along = 0.0;
    GeographicLib::Geodesic::WGS84().Inverse(place.latitude_deg, place.longitude_deg, fix.latitude_deg,
                                             fix.longitude_deg, along);
    return std::hypot(along, place.altitude_m - fix.altitude_m);
}

// Places that plain latitude and longitude arithmetic gets wrong.
const std::vector<std::vector<TrackFix>> kTracks{
    {{0, 46.50, 8.25, 1500, {}},
     {1, 46.5003, 8.2502, 1510, {}},
     {3, 46.5009, 8.2511, 1490, {}},
     {9, 46.502, 8.2500, 1495, {}}},
    {{0, 10.0, 179.999, 900, {}}, {10, 10.001, -179.9995, 905, {}}, {20, 10.0, -179.998, 910, {}}},
    {{0, 89.9995, 10.0, 500, {}}, {10, 89.9999, 12.0, 510, {}}, {20, 89.9996, -170.0, 520, {}}},
};

TEST(TrackCurve, PassesThroughItsFixes) {
    for (const auto& fixes : kTracks) {
        const TrackCurve curve(track_of(fixes));
        for (const TrackFix& fix : fixes) {
            EXPECT_LT(metres_between(curve.place(curve.at(fix.time_s).position_m), fix), 1e-4) << fix.time_s;
        }
    }
}

TEST(TrackCurve, VelocityIsTheSlopeOfPositionAndContinuous) {
    constexpr double kStep = 1e-4;
    for (const auto& fixes : kTracks) {
        const TrackCurve curve(track_of(fixes));
        for (double t = fixes.front().time_s + 0.01; t < fixes.back().time_s - 0.01; t += 0.0937) {
            const auto before = curve.at(t - kStep), now = curve.at(t), after = curve.at(t + kStep);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const double slope = (after.position_m[axis] - before.position_m[axis]) / (2 * kStep);
                EXPECT_NEAR(now.velocity_mps[axis], slope, 1e-2) << t;
            }
        }
        for (std::size_t i = 1; i + 1 < fixes.size(); ++i) {
            const auto before = curve.at(fixes[i].time_s - 1e-9), after = curve.at(fixes[i].time_s + 1e-9);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                EXPECT_NEAR(before.velocity_mps[axis], after.velocity_mps[axis], 1e-5);
            }
        }
    }
}

TEST(TrackCurve, StraightFlightIsStraightAndEven) {
    // Due north along a meridian at 100 m/s for 60 s, by GeographicLib's geodesic.
    std::vector<TrackFix> fixes;
    for (int t = 0; t <= 60; t += 5) {
        double latitude = 0, longitude = 0;
        GeographicLib::Geodesic::WGS84().Direct(46.0, 8.0, 0.0, 100.0 * t, latitude, longitude);
        fixes.push_back({double(t), latitude, longitude, 0.0, {}});
    }
    const TrackCurve curve(track_of(fixes));
    for (double t = 6.0; t < 54.0; t += 0.31) {
        double latitude = 0, longitude = 0;
        GeographicLib::Geodesic::WGS84().Direct(46.0, 8.0, 0.0, 100.0 * t, latitude, longitude);
        EXPECT_LT(metres_between(curve.place(curve.at(t).position_m), {t, latitude, longitude, 0.0, {}}),
                  0.01)
            << t;
    }
}

TEST(TrackCurve, DoesNotSwingOutOfAHaltOrAGap) {
    // 20 m/s, a halt of 10 s, then a gap of 10 minutes in which it moved 300 m.
    const double step = 20.0 / 111'200.0;
    const std::vector<TrackFix> fixes{{0, 46.0, 8.0, 500, {}},
                                      {1, 46.0 + step, 8.0, 500, {}},
                                      {2, 46.0 + 2 * step, 8.0, 500, {}},
                                      {12, 46.0 + 2 * step, 8.0, 500, {}},
                                      {612, 46.0 + 17 * step, 8.0, 500, {}},
                                      {613, 46.0 + 18 * step, 8.0, 500, {}}};
    const TrackCurve curve(track_of(fixes));
    for (double t = 2.0; t <= 12.0; t += 0.1) {
        EXPECT_LT(metres_between(curve.place(curve.at(t).position_m), fixes[2]), 1e-3) << t;
    }
    for (double t = 12.0; t <= 612.0; t += 1.0) {
        const auto place = curve.place(curve.at(t).position_m);
        EXPECT_GE(place.latitude_deg, fixes[3].latitude_deg - 1e-9);
        EXPECT_LE(place.latitude_deg, fixes[4].latitude_deg + 50.0 / 111'200.0);
    }
}

TEST(TrackCurve, StandsStillOutsideItsTimes) {
    const TrackCurve curve(track_of(kTracks[0]));
    EXPECT_EQ(curve.at(-5.0).position_m, curve.at(0.0).position_m);
    EXPECT_EQ(curve.at(-5.0).velocity_mps, Vector3{});
    EXPECT_EQ(curve.at(99.0).position_m, curve.at(9.0).position_m);
    EXPECT_EQ(curve.at(99.0).velocity_mps, Vector3{});
}

}  // namespace
}  // namespace eyepoint::tools
