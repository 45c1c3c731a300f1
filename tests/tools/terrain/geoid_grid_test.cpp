// The geoid grid that the build makes from proj-data, against published points.
#include <gtest/gtest.h>

#include "terrain/geodesy/geoid.hpp"

namespace eyepoint {
namespace {

struct Point {
    double latitude_deg, longitude_deg, undulation_m;
};

// NIMA's test points of its EGM96 program (F477, file OUTF477.DAT). The 15-minute grid with cubic
// interpolation is within 0.17 m anywhere (GeographicLib's documentation) and was measured within 8 mm here.
TEST(GeoidGrid, AgreesWithTheTestPointsOfEgm96) {
    const auto geoid = terrain::Geoid::load(EYEPOINT_BINARY_DIR "/share/eyepoint/egm96-15.pgm");
    ASSERT_TRUE(geoid.has_value()) << geoid.error();
    for (const Point& point :
         {Point{38.6281550, 269.7791550, -31.628}, Point{-14.6212170, 305.0211140, -2.969},
          Point{46.8743190, 102.4487290, -43.575}, Point{-23.6174460, 133.8747120, 15.871},
          Point{38.6254730, 359.9995000, 50.066}, Point{-0.4667440, 0.0023000, 17.329}}) {
        EXPECT_NEAR(geoid->undulation_m(point.latitude_deg, point.longitude_deg), point.undulation_m, 0.02)
            << point.latitude_deg << " " << point.longitude_deg;
    }
}

}  // namespace
}  // namespace eyepoint
