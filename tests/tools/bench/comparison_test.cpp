#include "tools/bench/regression/comparison.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/tools/report/scratch_folder.hpp"
#include "tools/bench/regression/bands.hpp"
#include "tools/bench/regression/flight_page.hpp"

namespace eyepoint::tools {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr std::size_t kFrames = 600;

/// A flight whose frames cost 10 ms, times `cost`, and half a percent more or less.
FlightResult result_of(double cost = 1.0, std::uint64_t seed = 1) {
    std::mt19937_64 random{seed};
    std::normal_distribution<double> noise{1.0, 0.005};
    FlightResult result;
    result.identity = {.program = "0.1.0",
                       .machine = "a processor, 2 cores",
                       .gl = {"llvmpipe", "4.5"},
                       .flight = "flight.pcap",
                       .flight_hash = "0123456789abcdef",
                       .terrain = "hills",
                       .size = {640, 360},
                       .rate_hz = 30.0,
                       .vertical_fov_deg = 40.0,
                       .tau_px = 2.0,
                       .lod_method = "nested",
                       .shading = "deferred"};
    result.frames = kFrames;
    for (std::size_t i = 0; i < kFrames; ++i) {
        result.columns["frame"].push_back(static_cast<double>(i + 1));
        result.columns["cpu_ms"].push_back(10.0 * cost * noise(random));
        result.columns["still_cpu_ms"].push_back(i % 5 == 0 ? 9.5 * noise(random)
                                                            : std::numeric_limits<double>::quiet_NaN());
        result.columns["selection_ms"].push_back(0.2 * cost * noise(random));
        result.columns["triangles"].push_back(25000.0 + static_cast<double>(i));
        result.columns["blocks_reused"].push_back(100.0);
        result.picture_hashes.push_back("00000000000000aa");
    }
    return result;
}

ComparedLine line_of(const Comparison& comparison, const std::string& what) {
    const auto line = std::ranges::find(comparison.lines, what, &ComparedLine::what);
    if (line == comparison.lines.end()) throw std::runtime_error("no line about " + what);
    return *line;
}

Comparison compared(const FlightResult& before, const FlightResult& after) {
    const auto comparison = compare(before, after);
    if (!comparison) throw std::runtime_error(comparison.error());
    return *comparison;
}

TEST(Compare, TwoRunsOfTheSameAreTheSame) {
    const Comparison comparison = compared(result_of(1.0, 1), result_of(1.0, 2));
    for (const ComparedLine& line : comparison.lines)
        EXPECT_EQ(line.verdict, Verdict::Same) << line.what << '\n' << describe(comparison);
    EXPECT_TRUE(comparison.passes(true));
}

TEST(Compare, ATwentiethMoreTimeAFrameIsWorseAndLessIsBetter) {
    const Comparison slower = compared(result_of(1.0, 1), result_of(1.05, 2));
    const ComparedLine price = line_of(slower, "frame CPU over that of a static mesh, median");
    EXPECT_EQ(price.verdict, Verdict::Worse);
    ASSERT_TRUE(price.change);
    EXPECT_NEAR(price.change->value, 1.05, 0.005);
    EXPECT_LT(price.change->low, 1.05);
    EXPECT_GT(price.change->high, 1.05);
    EXPECT_FALSE(slower.passes(false));
    const Comparison faster = compared(result_of(1.05, 1), result_of(1.0, 2));
    EXPECT_EQ(line_of(faster, "frame CPU, ms, median").verdict, Verdict::Better);
    EXPECT_TRUE(faster.passes(false));
}

TEST(Compare, ACountThatGrewInOneFrameIsWorseAndTheFrameIsNamed) {
    FlightResult after = result_of();
    after.columns["triangles"][41] += 1.0;
    const Comparison comparison = compared(result_of(), after);
    EXPECT_EQ(line_of(comparison, "triangles").verdict, Verdict::Worse);
    EXPECT_THAT(line_of(comparison, "triangles").remark, HasSubstr("first in frame 42: 25041, then 25042"));
    EXPECT_FALSE(comparison.passes(false));
}

TEST(Compare, FewerIsBetterExceptOfWhatSavesWork) {
    FlightResult after = result_of();
    after.columns["triangles"][0] -= 1.0;
    EXPECT_TRUE(compared(result_of(), after).passes(false));
    EXPECT_FALSE(compared(result_of(), after).passes(true));
    after = result_of();
    after.columns["blocks_reused"][0] -= 1.0;
    EXPECT_EQ(line_of(compared(result_of(), after), "blocks reused").verdict, Verdict::Worse);
}

TEST(Compare, AnotherPictureIsToldOnTheSameGlAlone) {
    FlightResult after = result_of();
    after.picture_hashes[9] = "00000000000000ab";
    const Comparison comparison = compared(result_of(), after);
    EXPECT_EQ(line_of(comparison, "pictures, by hash").verdict, Verdict::Different);
    EXPECT_FALSE(comparison.passes(false));
    after.identity.gl.version = "4.6";
    EXPECT_THAT(describe(compared(result_of(), after)), HasSubstr("hashes not compared, as OpenGL differs"));
    EXPECT_TRUE(compared(result_of(), after).passes(true));
}

TEST(Compare, TimesAreForOneMachineAndRatiosForAll) {
    FlightResult after = result_of(3.0);
    for (double& still_ms : after.columns["still_cpu_ms"]) still_ms *= 3.0;
    EXPECT_FALSE(compared(result_of(), after).passes(false));
    after.identity.machine = "another, 64 cores";
    const Comparison comparison = compared(result_of(), after);
    EXPECT_TRUE(comparison.passes(false)) << describe(comparison);
    EXPECT_THAT(describe(comparison),
                AllOf(HasSubstr("times: not compared"), Not(HasSubstr("frame CPU, ms"))));
}

TEST(Compare, FlightsFlownInAnotherWayAreRefusedByNameOfWhatDiffers) {
    FlightResult after = result_of();
    after.identity.tau_px = 1.0;
    EXPECT_THAT(compare(result_of(), after).error(), HasSubstr("differ in tolerance (2 and 1)"));
    after = result_of();
    after.identity.flight_hash = "other";
    EXPECT_THAT(compare(result_of(), after).error(), HasSubstr("differ in the recording"));
}

TEST(FlightResultFile, IsReadBackAsItWasWritten) {
    const FlightResult written = result_of();
    const auto read = parse_flight_result(to_json_text(written));
    ASSERT_TRUE(read) << read.error();
    EXPECT_EQ(read->columns.at("triangles"), written.columns.at("triangles"));
    EXPECT_EQ(read->picture_hashes, written.picture_hashes);
    EXPECT_EQ(read->identity.gl.renderer, "llvmpipe");
    EXPECT_NEAR(read->columns.at("cpu_ms")[3], written.columns.at("cpu_ms")[3], 1e-4);
    EXPECT_TRUE(std::isnan(read->columns.at("still_cpu_ms")[1]));
}

TEST(FlightResultFile, FaultsAreNamed) {
    EXPECT_THAT(parse_flight_result("no JSON").error(), HasSubstr("no flight result"));
    EXPECT_THAT(parse_flight_result("{}").error(), HasSubstr("no flight result"));
    EXPECT_THAT(parse_flight_result("{\"eyepoint_flight_result\": 99}").error(), HasSubstr("version 99"));
    EXPECT_THAT(parse_flight_result("{\"eyepoint_flight_result\": 1}").error(), HasSubstr("with a fault"));
    FlightResult uneven = result_of();
    uneven.columns["triangles"].pop_back();
    EXPECT_THAT(parse_flight_result(to_json_text(uneven)).error(), HasSubstr("differ in length"));
    EXPECT_THAT(read_flight_result("/no/such/file").error(), HasSubstr("/no/such/file"));
}

TEST(FlightResultFile, CountsAloneHoldNothingThatDiffersFromMachineToMachine) {
    const std::string text = to_json_text(counts_of(result_of()));
    EXPECT_THAT(text, AllOf(HasSubstr("triangles"), Not(HasSubstr("_ms")), Not(HasSubstr("processor")),
                            Not(HasSubstr("00000000000000aa"))));
}

TEST(Bands, ARatioAboveItsBandOrMissingIsWorse) {
    const std::vector<Band> bands{
        {"price_of_lod", 1.1, "why"}, {"selection_over_frame", 0.001, "why"}, {"none", 1.0, ""}};
    const auto lines = judge(result_of(), bands);
    ASSERT_EQ(lines.size(), 3U);
    EXPECT_EQ(lines[0].verdict, Verdict::Same);
    EXPECT_EQ(lines[1].verdict, Verdict::Worse);
    EXPECT_EQ(lines[2].verdict, Verdict::Worse);
}

TEST(Bands, AreReadWithTheirReasonsAndFaultsAreNamed) {
    const test::ScratchFolder folder;
    const auto bands = read_bands(folder.file("bands.json", R"({"a": {"at_most": 2, "reason": "so"}})"));
    ASSERT_TRUE(bands) << bands.error();
    EXPECT_EQ(bands->front().reason, "so");
    EXPECT_THAT(read_bands(folder.file("faulty.json", R"({"a": {"at_most": 2}})")).error(),
                HasSubstr("faulty.json"));
}

TEST(FlightPage, IsWholeInItselfAndSaysThePrice) {
    const auto page = flight_page(result_of());
    ASSERT_TRUE(page) << page.error();
    EXPECT_THAT(*page, AllOf(HasSubstr("static mesh, median</dt><dd>1.05"), HasSubstr("default-src 'none'"),
                             HasSubstr("Chart.js v"), HasSubstr("\"price_of_lod\":[")));
}

}  // namespace
}  // namespace eyepoint::tools
