/// The nested method over the benchmark field, on both of its paths. Skipped where EYEPOINT_REAL_DATA is not
/// set.
#include <filesystem>
#include <map>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/picture/flights.hpp"
#include "tests/proof/proven_flight.hpp"
#include "tools/bench/planar_path.hpp"

namespace eyepoint::testing {
namespace {

class FieldProof : public ::testing::Test {
  protected:
    static void SetUpTestSuite() {
        if (!real_data()) return;
        database_ = open_database(EYEPOINT_FIELD_TERRAIN);
        flight_ = std::make_unique<ProvenFlight>(database_);
        for (const std::string path : {"cruise", "sweep"}) {
            eyes_[path] = tools::read_planar_path(*real_data() / "benchmark" / (path + ".csv"),
                                                  tools::kRainierField, {800, 800}, 40.0)
                              .value();
        }
    }
    static void TearDownTestSuite() {
        flight_.reset();
        database_.reset();
    }
    void SetUp() override {
        if (!real_data()) GTEST_SKIP() << "EYEPOINT_REAL_DATA is not set: no benchmark field to fly over";
    }

    /// All tolerances, each looking at other frames.
    static void fly_all(const std::string& path, std::size_t every) {
        for (std::size_t i = 0; i < kTolerances.size(); ++i) {
            const Tolerance& tolerance = kTolerances[i];
            const auto views = views_of(eyes_.at(path), tolerance);
            const std::size_t start = every_frame() ? 0 : i * every / kTolerances.size();
            expect_sound(
                flight_->fly(std::span{views}.subspan(start), {.every = one_in(every), .pops = false}),
                fmt::format("{}, tau {}, slack {} tau", path, tolerance.tau_px, tolerance.slack_share));
        }
    }

    static std::shared_ptr<const terrain::Database> database_;
    static std::unique_ptr<ProvenFlight> flight_;
    static std::map<std::string, std::vector<ig::FlightEye>> eyes_;
};
std::shared_ptr<const terrain::Database> FieldProof::database_;
std::unique_ptr<ProvenFlight> FieldProof::flight_;
std::map<std::string, std::vector<ig::FlightEye>> FieldProof::eyes_;

TEST_F(FieldProof, CruiseIsWholeAndWithinTheTolerance) { fly_all("cruise", 300); }

TEST_F(FieldProof, SweepIsWholeAndWithinTheTolerance) { fly_all("sweep", 300); }

TEST_F(FieldProof, NoPostJumpsByAQuarterOfAPixelOnCruise) {
    constexpr double kMostPopPx = 0.25;
    const auto views = views_of(eyes_.at("cruise"), {1.0, 0.1});
    const Findings morphed = flight_->fly(views, {.every = one_in(60)});
    const Findings jumping = flight_->fly(views, {.every = one_in(60), .morph = false, .faults = false});
    const double morphed_px = morphed.figures.pops.maximum(), jumping_px = jumping.figures.pops.maximum();
    fmt::print("largest jump {:.3f} px, with morph off {:.3f} px\n", morphed_px, jumping_px);
    EXPECT_GT(morphed.figures.pops.count(), 100000U);
    EXPECT_LE(morphed_px, kMostPopPx);
    EXPECT_GT(jumping_px, 2.0 * morphed_px);
}

TEST_F(FieldProof, IsWholeWhileAFewBlocksArriveAFrame) {
    constexpr std::size_t kFrames = 40;
    const auto views = views_of(eyes_.at("sweep"), {1.0, 0.1});
    for (const std::size_t start : {std::size_t{0}, std::size_t{300}}) {
        EXPECT_GT(
            expect_whole_while_loading(
                database_, std::span{views}.subspan(start, every_frame() ? 300 : kFrames), 7, one_in(13)),
            kFrames / 2);
    }
}

}  // namespace
}  // namespace eyepoint::testing
