/// What is claimed of a method from a thousand random eyes over hills, some inside blocks.
#pragma once

#include <memory>

#include <gtest/gtest.h>

#include "tests/proof/proven_flight.hpp"
#include "tests/proof/random_walk.hpp"

namespace eyepoint::testing {

class ThousandEyes : public ::testing::Test {
  protected:
    static void SetUpTestSuite() {
        hills_ = std::make_unique<AnalyticPlanet>(AnalyticTerrain{.half_size_deg = 0.3, .detail_depth = 11});
    }
    static void TearDownTestSuite() { hills_.reset(); }

    /// Looks at what a method draws at every eye, at a tolerance of 1 px and a slack of 0.1.
    [[nodiscard]] static Findings fly(const tools::FlightOptions& options) {
        ProvenFlight flight(hills_->database(), options);
        const auto views = RandomWalk{hills_->terrain(), 20261122}.views(1000, 1.0, 0.1);
        const Findings findings = flight.fly(views, {.every = 1, .far_m = 40000.0, .pops = false});
        RecordProperty("posts_beyond", static_cast<int>(findings.beyond));
        return findings;
    }

  private:
    static inline std::unique_ptr<AnalyticPlanet> hills_;
};

}  // namespace eyepoint::testing
