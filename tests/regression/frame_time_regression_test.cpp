/// The frame-time regression's short form: the sample flight over the synthetic planet, a frame a second.
///
/// When counts are meant to change, keep the new ones and look at what changed (git diff):
///     EYEPOINT_BLESS=1 ctest --test-dir build/release -R 'MakeSyntheticTerrain|frame_time_regression_test'
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "terrain/lod/nested.hpp"
#include "tests/picture/flights.hpp"
#include "tools/bench/allocation_count.hpp"
#include "tools/bench/bench_run.hpp"
#include "tools/bench/regression/bands.hpp"
#include "tools/bench/regression/bench_result_columns.hpp"
#include "tools/bench/regression/comparison.hpp"
#include "tools/report/page.hpp"

namespace eyepoint::testing {
namespace {

using tools::Comparison;
using tools::FlightResult;
using tools::Verdict;

constexpr ig::PictureSize kSize{320, 180};
constexpr double kRateHz = 1.0;
const std::filesystem::path kExpected = EYEPOINT_SOURCE_DIR "/tests/regression/expected-counts.json";
const std::filesystem::path kBands = EYEPOINT_SOURCE_DIR "/tests/regression/bands.json";

template <typename Value>
Value value_or_throw(tl::expected<Value, std::string> got) {
    if (!got) throw std::runtime_error(got.error());
    return std::move(*got);
}

tools::BenchOptions way_of_flying() {
    tools::BenchOptions options;
    options.terrain = EYEPOINT_SYNTHETIC_TERRAIN;
    options.size = kSize;
    options.scene.lod_method = "nested";
    options.scene.shading = ig::Shading::Deferred;
    options.hash_pictures = true;
    options.allocations = tools::heap_allocations;
    return options;
}

FlightResult flown(const tools::BenchOptions& options) {
    const auto bench = value_or_throw(tools::run_bench(options, eyes_of(sample_flight(), kSize, kRateHz)));
    return tools::flight_result(bench, {.program = "test",
                                        .machine = "this one",
                                        .gl = {},
                                        .flight = sample_flight().filename().string(),
                                        .flight_hash = "of the tree",
                                        .terrain = {},
                                        .size = kSize,
                                        .rate_hz = kRateHz,
                                        .vertical_fov_deg = config::ViewSettings{}.vertical_fov_deg,
                                        .tau_px = options.scene.tau_px,
                                        .lod_method = options.scene.lod_method,
                                        .shading = {},
                                        .streaming = false});
}

/// Flown once for all tests.
const FlightResult& reference() {
    static const FlightResult kReference = flown(way_of_flying());
    return kReference;
}

/// The build that a change has slowed down: every block is evaluated in every frame.
FlightResult flown_without_reuse() {
    tools::BenchOptions options = way_of_flying();
    options.method = [] { return std::make_unique<terrain::NestedLod>(false); };
    return flown(options);
}

Verdict verdict_of(const Comparison& comparison, const std::string& what) {
    const auto line = std::ranges::find(comparison.lines, what, &tools::ComparedLine::what);
    if (line == comparison.lines.end()) throw std::runtime_error("no line about " + what);
    return line->verdict;
}

bool blessed() { return std::getenv("EYEPOINT_BLESS") != nullptr; }

TEST(FrameTimeRegression, CountsAreThoseInTheTree) {
    if (blessed()) {
        const auto written = tools::write_whole(kExpected, to_json_text(counts_of(reference())));
        ASSERT_TRUE(written) << written.error();
    }
    const auto comparison =
        value_or_throw(compare(value_or_throw(tools::read_flight_result(kExpected)), reference()));
    EXPECT_TRUE(comparison.passes(true)) << describe(comparison);
}

/// Flown several times; of each frame the least times, because what other programs do beside only adds.
FlightResult calm(const tools::BenchOptions& options) {
    constexpr int kFlights = 3;
    FlightResult result = flown(options);
    for (int flight = 1; flight < kFlights; ++flight) {
        const FlightResult again = flown(options);
        for (auto& [key, column] : result.columns) {
            if (!tools::is_timing(key)) continue;
            std::ranges::transform(column, again.columns.at(key), column.begin(),
                                   [](double one, double other) { return std::min(one, other); });
        }
    }
    return result;
}

TEST(FrameTimeRegression, RatiosAreInTheirBands) {
    tools::BenchOptions options = way_of_flying();
    options.still_every = 2;
    for (const tools::ComparedLine& line : judge(calm(options), value_or_throw(tools::read_bands(kBands)))) {
        EXPECT_EQ(line.verdict, Verdict::Same) << line.what << ": " << line.after << "; " << line.remark;
    }
}

/// By counts, which no machine blurs: choosing blocks is a fifth of selection's time at most.
TEST(FrameTimeRegression, ABuildThatEvaluatesEveryBlockInEveryFrameFails) {
    const FlightResult slowed = flown_without_reuse();
    for (const FlightResult& before : {value_or_throw(tools::read_flight_result(kExpected)), reference()}) {
        const auto comparison = value_or_throw(compare(before, slowed));
        EXPECT_FALSE(comparison.passes(false)) << describe(comparison);
        EXPECT_EQ(verdict_of(comparison, "blocks evaluated"), Verdict::Worse);
        EXPECT_EQ(verdict_of(comparison, "blocks reused"), Verdict::Worse);
    }
}

/// Every column that is no time, and every picture, bit by bit.
void expect_same(const FlightResult& one, const FlightResult& other) {
    ASSERT_EQ(one.frames, other.frames);
    for (const auto& [key, column] : one.columns) {
        if (tools::is_timing(key)) continue;
        EXPECT_THAT(other.columns.at(key), ::testing::ContainerEq(column)) << key;
    }
    EXPECT_EQ(one.picture_hashes, other.picture_hashes);
}

TEST(Determinism, TheSameRecordingGivesTheSameFramesAndRecordsAgain) {
    ASSERT_EQ(reference().picture_hashes.size(), reference().frames);
    expect_same(reference(), flown(way_of_flying()));
}

TEST(Determinism, AndWithTwoLoaderThreads) {
    tools::BenchOptions options = way_of_flying();
    options.scene.loader_threads = 2;
    expect_same(reference(), flown(options));
}

TEST(Determinism, PicturesOfDifferentFramesDiffer) {
    std::vector<std::string> hashes = reference().picture_hashes;
    std::ranges::sort(hashes);
    EXPECT_GT(std::ranges::unique(hashes).begin() - hashes.begin(),
              static_cast<long>(hashes.size() * 9 / 10));
}

}  // namespace
}  // namespace eyepoint::testing
