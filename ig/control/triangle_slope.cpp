#include "ig/control/triangle_slope.hpp"

#include <algorithm>
#include <cmath>

namespace eyepoint::ig {

namespace {

/// What is expected before anything is seen (levels of a rough surface: error halves, triangles double), with
/// the weight of one step of tau by a fifth.
constexpr double kFirstSlope = 1.0, kFirstWeight = 0.04;
constexpr double kLeastSlope = 0.3, kMostSlope = 1.6;
/// Of what was learned, kept from step to step.
constexpr double kMemory = 0.98;
/// Smaller changes of log tau's step say nothing above the demand's own jitter.
constexpr double kLeastChange = 0.005;

}  // namespace

void TriangleSlope::learn(double tau_px, double triangles) {
    const Frame frame{std::log(tau_px), std::log(triangles)};
    if (last_) {
        const Frame step{frame.log_tau - last_->log_tau, frame.log_triangles - last_->log_triangles};
        if (last_step_) {
            const double tau_change = step.log_tau - last_step_->log_tau;
            if (std::abs(tau_change) > kLeastChange) {
                product_ = kMemory * product_ - tau_change * (step.log_triangles - last_step_->log_triangles);
                square_ = kMemory * square_ + tau_change * tau_change;
            }
        }
        last_step_ = step;
    }
    last_ = frame;
}

void TriangleSlope::interrupt() {
    last_.reset();
    last_step_.reset();
}

double TriangleSlope::slope() const {
    return std::clamp((product_ + kFirstSlope * kFirstWeight) / (square_ + kFirstWeight), kLeastSlope,
                      kMostSlope);
}

}  // namespace eyepoint::ig
