/// A scene that costs what a formula says: for tests of what controls it.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <random>
#include <span>
#include <vector>

#include "ig/control/tolerance_controller.hpp"

namespace eyepoint::ig {

/// What frame n costs: triangles = demand * tau^-slope, cost = pixels_ms + ms_a_triangle * triangles.
struct SimulatedLoad {
    double pixels_ms = 5.0;
    double ms_a_triangle = 1e-4;
    double demand = 80000.0;  ///< triangles at tau 1
    double other_ms = 0.0;    ///< beside the drawing
};

struct Simulation {
    ControlTarget target;
    std::size_t frames = 600;
    std::function<SimulatedLoad(std::size_t frame)> load;
    double slope = 1.0;
    double noise = 0.03;        ///< standard deviation of a measured cost, a share of it
    double demand_noise = 0.0;  ///< the same of the triangles
    double spike_chance = 0.0;  ///< of a single frame that costs twice as much: uploads
    std::size_t delay = 0;      ///< frames between a frame and its report, beyond the one there always is
    std::uint32_t seed = 1;
};

struct SimulatedFrame {
    double tau_px = 0.0;
    double triangles = 0.0;
    double true_ms = 0.0;      ///< without noise and spikes
    ControlDecision decision;  ///< after it
};

inline std::vector<SimulatedFrame> simulate(const Simulation& simulation) {
    std::mt19937 random(simulation.seed);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> uniform;
    ToleranceController controller(simulation.target);
    std::vector<SimulatedFrame> frames;
    std::vector<FrameCost> reports;
    std::size_t since_spike = 0;
    for (std::size_t n = 0; n < simulation.frames; ++n) {
        const SimulatedLoad load = simulation.load(n);
        SimulatedFrame frame;
        frame.tau_px = controller.tau_px();
        frame.triangles = load.demand * std::pow(frame.tau_px, -simulation.slope) *
                          std::exp(simulation.demand_noise * normal(random));
        const double drawn_ms = load.pixels_ms + load.ms_a_triangle * frame.triangles;
        frame.true_ms = drawn_ms + load.other_ms;
        const bool spike = ++since_spike > 2 && uniform(random) < simulation.spike_chance;
        if (spike) since_spike = 0;
        const double spike_ms = spike ? drawn_ms : 0.0;
        const double measured_ms = drawn_ms * std::exp(simulation.noise * normal(random)) + spike_ms;
        reports.push_back({frame.tau_px, frame.triangles, measured_ms, load.other_ms, false});
        if (n >= simulation.delay) frame.decision = controller.next(reports[n - simulation.delay]);
        frames.push_back(frame);
    }
    return frames;
}

}  // namespace eyepoint::ig
