/// The nested method on a recorded flight over the synthetic planet.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/picture/flights.hpp"
#include "tests/proof/proven_flight.hpp"

namespace eyepoint::testing {
namespace {

TEST(RecordedFlightProof, IsWholeAndWithinTheTolerance) {
    ProvenFlight flight(open_synthetic_terrain());
    const auto eyes = eyes_of(sample_flight(), {800, 800}, 30.0);
    const std::size_t every = eyes.size() / 2;
    for (std::size_t i = 0; i < kTolerances.size(); ++i) {
        const Tolerance& tolerance = kTolerances[i];
        const auto views = views_of(eyes, tolerance);
        const std::size_t start = every_frame() ? 0 : i * every / kTolerances.size();
        expect_sound(flight.fly(std::span{views}.subspan(start), {.every = one_in(every), .pops = false}),
                     fmt::format("tau {}, slack {} tau", tolerance.tau_px, tolerance.slack_share));
    }
}

TEST(RecordedFlightProof, IsWholeWhileAFewBlocksArriveAFrame) {
    const auto views = views_of(eyes_of(sample_flight(), {800, 800}, 30.0), {1.0, 0.1});
    const std::size_t frames = every_frame() ? 900 : 60;
    EXPECT_GT(expect_whole_while_loading(open_synthetic_terrain(), std::span{views}.subspan(0, frames), 5,
                                         one_in(20)),
              frames / 2);
}

}  // namespace
}  // namespace eyepoint::testing
