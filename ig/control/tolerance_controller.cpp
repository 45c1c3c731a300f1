#include "ig/control/tolerance_controller.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace eyepoint::ig {

namespace {

/// The dead band: tau starts to move when the expected cost is above or below the target by more than these
/// shares, and stops within the last.
constexpr double kBandAbove = 0.03, kBandBelow = 0.045, kBandStop = 0.01;
/// With noisy costs it is wider: so many deviations of the expected cost, up to the most.
constexpr double kBandDeviations = 3.0, kBandMost = 0.06;
/// Of the way to the goal in log tau, gone in one frame; and the most.
constexpr double kCoarseningGain = 0.4, kRefiningGain = 0.15;
constexpr double kMostCoarsening = 0.25, kMostRefining = 0.1;
/// This near to its goal, in log tau, it goes there at once, so that a bound is reached.
constexpr double kArrived = 0.005;
/// exp(log(x)) over x, at most.
constexpr double kRounding = 1.0 + 1e-12;
/// Over the target by less is not called unreachable.
constexpr double kUnreachable = 0.03;
/// Coarsening that takes off less than this share of what is too much is in vain; once held, it has to be
/// worth the second share to begin again.
constexpr double kWorthwhile = 0.25, kWorthwhileAgain = 0.5;
/// What is known of the terrain's cost when coarsening may be given up: its deviation, as a share of the
/// target.
constexpr double kCertain = 0.1;

bool positive(double value) { return std::isfinite(value) && value > 0.0; }

}  // namespace

std::string_view name(ControlState state) {
    constexpr std::array<std::string_view, 7> kNames{"steady", "coarsening", "refining", "awaiting terrain",
                                                     "finest", "coarsest",   "held"};
    return kNames[static_cast<std::size_t>(state)];
}

/// What the models say of the next frame.
struct ToleranceController::Outlook {
    double excess = 0.0;            ///< expected cost with tau as it is over the target, less 1
    double coarsest_excess = 0.0;   ///< the same at the greatest tau
    double blameless_excess = 0.0;  ///< the same at the last tau that met the target
    double goal_log_tau = 0.0;      ///< where the target would be met, within the bounds
    double uncertain = 0.0;         ///< so far off the target the expected cost may be by its noise alone
};

ToleranceController::ToleranceController(const ControlTarget& target)
    : target_(target),
      tau_px_(std::clamp(target.nominal_tau_px, target.tau_min_px, target.tau_max_px)),
      blameless_tau_px_(tau_px_),
      before_step_tau_px_(tau_px_) {}

ControlDecision ToleranceController::next(const FrameCost& frame) {
    const bool valid = positive(frame.tau_px) && positive(frame.triangles) && positive(frame.cost_ms) &&
                       std::isfinite(frame.other_ms) && frame.other_ms >= 0.0;
    if (!valid) return {tau_px_, state_, 0.0};
    others_ms_ = {others_ms_[1], others_ms_[2], frame.other_ms};
    const CostModel::Reading reading = model_.learn(frame.triangles, frame.cost_ms);
    if (frame.awaits_terrain) {
        slope_.interrupt();
    } else {
        slope_.learn(frame.tau_px, frame.triangles);
    }
    if (reading == CostModel::Reading::Step) before_step_tau_px_ = tau_px_;
    if (reading == CostModel::Reading::StepBack) tau_px_ = before_step_tau_px_;
    const Outlook expected = outlook(frame);
    if (reading != CostModel::Reading::Spike && reading != CostModel::Reading::First) {
        state_ = state_of(expected, frame);
        move(state_, expected);
    }
    if (expected.excess <= kBandAbove) blameless_tau_px_ = tau_px_;
    const double stays = state_ == ControlState::Coarsest ? expected.coarsest_excess
                         : state_ == ControlState::Held   ? expected.excess
                                                          : 0.0;
    return {tau_px_, state_, std::max(0.0, stays)};
}

ToleranceController::Outlook ToleranceController::outlook(const FrameCost& frame) const {
    const double others_ms = std::max(std::min(others_ms_[0], others_ms_[1]),
                                      std::min(std::max(others_ms_[0], others_ms_[1]), others_ms_[2]));
    const double steady_ms = model_.fixed_ms() + others_ms;
    const auto excess_at = [&](double tau_px) {
        return (steady_ms + model_.terrain_ms(triangles_at(tau_px, frame))) / target_.frame_ms - 1.0;
    };
    const double least = std::log(target_.tau_min_px), most = std::log(target_.tau_max_px);
    const double terrain_ms = model_.terrain_ms(frame.triangles), left_ms = target_.frame_ms - steady_ms;
    double goal = most;
    if (left_ms > 0.0) {
        goal = std::log(frame.tau_px) + std::log(terrain_ms / left_ms) / slope_.slope();
        goal = std::clamp(goal, least, most);
    }
    return {excess_at(tau_px_), excess_at(target_.tau_max_px), excess_at(blameless_tau_px_), goal,
            std::min(kBandDeviations * model_.uncertainty_ms(frame.triangles) / target_.frame_ms, kBandMost)};
}

double ToleranceController::triangles_at(double tau_px, const FrameCost& frame) const {
    return frame.triangles * std::pow(frame.tau_px / tau_px, slope_.slope());
}

bool ToleranceController::in_vain(const Outlook& outlook, const FrameCost& frame) const {
    const double worthwhile = state_ == ControlState::Held ? kWorthwhileAgain : kWorthwhile;
    const bool certain = model_.terrain_uncertainty_ms(frame.triangles) < kCertain * target_.frame_ms;
    const double gain = outlook.blameless_excess - outlook.coarsest_excess;
    return certain && gain < worthwhile * outlook.blameless_excess;
}

ControlState ToleranceController::state_of(const Outlook& outlook, const FrameCost& frame) const {
    const bool moving = state_ == ControlState::Coarsening || state_ == ControlState::Refining;
    if (outlook.excess > (moving ? kBandStop : std::max(kBandAbove, outlook.uncertain))) {
        if (outlook.coarsest_excess <= kUnreachable) return ControlState::Coarsening;
        return in_vain(outlook, frame) ? ControlState::Held : ControlState::Coarsest;
    }
    if (outlook.excess >= (moving ? -kBandStop : -std::max(kBandBelow, outlook.uncertain)))
        return ControlState::Steady;
    if (frame.awaits_terrain) return ControlState::AwaitingTerrain;
    return tau_px_ <= target_.tau_min_px * kRounding ? ControlState::Finest : ControlState::Refining;
}

void ToleranceController::move(ControlState state, const Outlook& outlook) {
    double goal = std::log(tau_px_);
    if (state == ControlState::Coarsening || state == ControlState::Refining) goal = outlook.goal_log_tau;
    if (state == ControlState::Coarsest) goal = std::log(target_.tau_max_px);
    if (state == ControlState::Held) goal = std::log(blameless_tau_px_);
    const double way = goal - std::log(tau_px_);
    const double step = std::abs(way) < kArrived ? way
                        : way > 0.0              ? std::min(kCoarseningGain * way, kMostCoarsening)
                                                 : std::max(kRefiningGain * way, -kMostRefining);
    tau_px_ = std::clamp(tau_px_ * std::exp(step), target_.tau_min_px, target_.tau_max_px);
}

}  // namespace eyepoint::ig
