#include "ig/control/cost_model.hpp"

#include <algorithm>
#include <cmath>

namespace eyepoint::ig {

namespace {

/// Nothing is known of the first frame's split: half and half, give or take.
constexpr double kFirstShare = 0.5, kFirstUncertainty = 0.35;
/// How far the costs are taken to wander in a frame, and in a step of the load; shares of themselves.
constexpr double kWander = 0.006, kStepWander = 0.6;
/// Of wandering, how much is common to both costs (a processor that slows down slows both).
constexpr double kCommon = 0.5;
/// The noise of costs: expected first, least and most; and how fast it is learned.
constexpr double kFirstNoise = 0.04, kLeastNoise = 0.01, kMostNoise = 0.25, kNoiseGain = 0.05;
/// A frame is surprising when off by so many deviations; a deviation counts as at least this share.
constexpr double kSurprise = 4.0, kLeastDeviation = 0.03;
/// Page's cumulative sum of deviations beyond the first is a step at the second: two surprising frames, three
/// off by three, or five off by two and a half. On steady noise that is one in half a million frames.
constexpr double kAllowance = 1.25, kStepSum = 4.6, kMostCounted = 3.6;
/// A load that goes back within so many frames was no step.
constexpr int kStepIsYoung = 15;
/// Less than this share of a frame is never taken to be the terrain's: the filter must stay able to see it.
constexpr double kLeastTerrainShare = 0.01;

}  // namespace

CostModel::Reading CostModel::learn(double triangles, double cost_ms) {
    if (scale_triangles_ <= 0.0) {
        begin(triangles, cost_ms);
        return Reading::First;
    }
    const double load = this->load(triangles);
    const double share = cost_ms / this->cost_ms(triangles) - 1.0;
    const Reading reading = judge(load, cost_ms);
    ++frames_since_step_;
    if (reading == Reading::Spike) return reading;
    if (reading == Reading::Usual) learn_noise(share);
    if (reading == Reading::Step) {
        before_step_ = now_;
        frames_since_step_ = 0;
    }
    if (reading == Reading::StepBack) now_ = before_step_;
    forget(reading == Reading::Step ? kStepWander : kWander);
    update(load, cost_ms);
    keep_physical(load, cost_ms);
    return reading;
}

void CostModel::begin(double triangles, double cost_ms) {
    scale_triangles_ = triangles;
    now_.slope = kFirstShare * cost_ms;
    now_.fixed = cost_ms - now_.slope;
    noise_share_ = kFirstNoise;
    frames_since_step_ = kStepIsYoung;
    // The sum is known as well as a frame tells it, the split hardly.
    const double split = kFirstUncertainty * cost_ms, sum = kFirstNoise * cost_ms;
    now_.p_ff = now_.p_ss = split * split + sum * sum / 4.0;
    now_.p_fs = -split * split + sum * sum / 4.0;
}

CostModel::Reading CostModel::judge(double load, double cost_ms) {
    const double deviations = surprise(now_, load, cost_ms);
    const double counted = std::clamp(deviations, -kMostCounted, kMostCounted);
    above_ = std::max(0.0, above_ + counted - kAllowance);
    below_ = std::max(0.0, below_ - counted - kAllowance);
    const bool surprising = std::abs(deviations) > kSurprise, step = std::max(above_, below_) > kStepSum;
    if (!surprising && !step) return Reading::Usual;
    const bool back =
        frames_since_step_ < kStepIsYoung && std::abs(surprise(before_step_, load, cost_ms)) < kSurprise;
    if (!back && !step) return Reading::Spike;
    above_ = below_ = 0.0;
    if (!back) return Reading::Step;
    frames_since_step_ = kStepIsYoung;
    return Reading::StepBack;
}

/// How far off a cost is, in deviations.
double CostModel::surprise(const Belief& belief, double load, double cost_ms) const {
    const double share = cost_ms / (belief.fixed + belief.slope * load) - 1.0;
    return share / std::max(noise_share_, kLeastDeviation);
}

/// From the mean deviation; what is far off counts no more than what is just not surprising.
void CostModel::learn_noise(double innovation_share) {
    const double deviation = std::abs(innovation_share) * std::sqrt(std::acos(-1.0) / 2.0);
    noise_share_ =
        std::clamp(noise_share_ + kNoiseGain * (deviation - noise_share_), kLeastNoise, kMostNoise);
}

/// The costs have wandered since the frame before, by this share of themselves. No uncertainty grows beyond
/// the cost it is of, or the filter would believe anything after a long steady flight.
void CostModel::forget(double share) {
    const double sum = now_.fixed + now_.slope;
    const double q_f = share * sum / 2.0, q_s = share * now_.slope;
    now_.p_ff += q_f * q_f;
    now_.p_ss += q_s * q_s;
    now_.p_fs += kCommon * q_f * q_s;
    const double excess = std::max(now_.p_ff, now_.p_ss) / (sum * sum);
    if (excess > 1.0) {
        now_.p_ff /= excess;
        now_.p_fs /= excess;
        now_.p_ss /= excess;
    }
}

/// The Kalman update for the observation row (1, load).
void CostModel::update(double load, double cost_ms) {
    const double expected_ms = now_.fixed + now_.slope * load, noise_ms = noise_share_ * expected_ms;
    const double h_f = now_.p_ff + now_.p_fs * load, h_s = now_.p_fs + now_.p_ss * load;
    const double variance = h_f + h_s * load + noise_ms * noise_ms;
    const double k_f = h_f / variance, k_s = h_s / variance;
    now_.fixed += k_f * (cost_ms - expected_ms);
    now_.slope += k_s * (cost_ms - expected_ms);
    now_.p_ff -= k_f * h_f;
    now_.p_fs -= k_f * h_s;
    now_.p_ss -= k_s * h_s;
}

/// Neither cost is below nothing; what one lacks the other takes, so that the sum stands.
void CostModel::keep_physical(double load, double cost_ms) {
    if (now_.fixed < 0.0) {
        now_.slope += now_.fixed / load;
        now_.fixed = 0.0;
    }
    const double least = kLeastTerrainShare * cost_ms / load;
    if (now_.slope < least) {
        now_.fixed = std::max(0.0, now_.fixed - (least - now_.slope) * load);
        now_.slope = least;
    }
}

double CostModel::uncertainty_ms(double triangles) const {
    const double l = load(triangles);
    return std::sqrt(std::max(0.0, now_.p_ff + 2.0 * now_.p_fs * l + now_.p_ss * l * l));
}

double CostModel::terrain_uncertainty_ms(double triangles) const {
    return std::sqrt(std::max(0.0, now_.p_ss)) * load(triangles);
}

}  // namespace eyepoint::ig
