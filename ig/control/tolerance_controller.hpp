/// Every frame in time: moves the tolerance so that frames cost what they may.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "ig/control/cost_model.hpp"
#include "ig/control/triangle_slope.hpp"

namespace eyepoint::ig {

struct ControlTarget {
    double frame_ms = 14.0;   ///< what a frame may cost in all, above 0
    double tau_min_px = 0.5;  ///< bounds of tau, 0 < min <= max
    double tau_max_px = 16.0;
    double nominal_tau_px = 2.0;  ///< begun with, and gone back to where the terrain is not to blame
};

/// One frame as it was drawn.
struct FrameCost {
    double tau_px = 0.0;          ///< that it was drawn with
    double triangles = 0.0;       ///< of terrain
    double cost_ms = 0.0;         ///< from its start until a fence said that it was whole, uploads included
    double other_ms = 0.0;        ///< what the frame took beside that and no tau changes: output
    bool awaits_terrain = false;  ///< much of what tau asks for is not loaded yet
};

enum class ControlState : std::uint8_t {
    Steady,           ///< within the dead band
    Coarsening,       ///< over the target
    Refining,         ///< under it
    AwaitingTerrain,  ///< under it, but what is finer is still being loaded
    Finest,           ///< under it at the least tau
    Coarsest,         ///< over it at the greatest tau: unreachable
    Held              ///< over it, and tau can do little about that: unreachable
};
/// "steady", "coarsening", ...; "awaiting terrain"
[[nodiscard]] std::string_view name(ControlState state);

struct ControlDecision {
    double tau_px = 0.0;  ///< for the next frame
    ControlState state = ControlState::Steady;
    double unreachable_share = 0.0;  ///< how far above the target frames stay, 0.2: 20%; Coarsest, Held
};

/// Values in, values out: no clock, no OpenGL; the same frames give the same tolerances.
///
/// Each frame teaches a model of the cost against the triangles (CostModel) and of the triangles against tau
/// (TriangleSlope). Together they say which tau would meet the target from here; tau goes there in log space,
/// most of the way at once when over the target, slowly when under it. Nothing is integrated, so nothing
/// winds up: at a bound, or while the terrain is not to blame, the goal is simply out of reach. Within the
/// dead band tau stands still. A single spike moves nothing; the second frame of a step does. Frames may be
/// reported late: each is judged by the tau it was drawn with. Thread use: one thread.
class ToleranceController {
  public:
    explicit ToleranceController(const ControlTarget& target);

    /// Called once a frame, in order. A frame with a value that is not finite, or not positive where it must
    /// be, is left out: tau stays.
    [[nodiscard]] ControlDecision next(const FrameCost& frame);

    [[nodiscard]] double tau_px() const { return tau_px_; }
    [[nodiscard]] const CostModel& model() const { return model_; }
    [[nodiscard]] double slope() const { return slope_.slope(); }

  private:
    struct Outlook;
    [[nodiscard]] Outlook outlook(const FrameCost& frame) const;
    [[nodiscard]] double triangles_at(double tau_px, const FrameCost& frame) const;
    [[nodiscard]] bool in_vain(const Outlook& outlook, const FrameCost& frame) const;
    [[nodiscard]] ControlState state_of(const Outlook& outlook, const FrameCost& frame) const;
    void move(ControlState state, const Outlook& outlook);

    ControlTarget target_;
    CostModel model_;
    TriangleSlope slope_;
    double tau_px_;
    double blameless_tau_px_;            ///< the last one that met the target
    double before_step_tau_px_;          ///< when the load last stepped
    std::array<double, 3> others_ms_{};  ///< of the last frames
    ControlState state_ = ControlState::Steady;
};

}  // namespace eyepoint::ig
