/// How triangles follow the tolerance, learned from the frames as they come.
#pragma once

#include <optional>

namespace eyepoint::ig {

/// p in: triangles ~ tau^-p, within 0.3..1.6.
///
/// A controller that does its work keeps the triangles still while tau follows the demand, so the two seen
/// together say nothing of p. What does is how the *change* of log triangles follows the *change* of log
/// tau's step from one frame to the next: a steady drift of the demand falls out of it. Thread use: one
/// thread.
class TriangleSlope {
  public:
    /// Of one frame, in the order they are drawn; tau_px > 0, triangles > 0.
    void learn(double tau_px, double triangles);
    /// The frames have a gap here, or triangles that tau does not account for.
    void interrupt();

    [[nodiscard]] double slope() const;

  private:
    struct Frame {
        double log_tau = 0.0, log_triangles = 0.0;
    };
    std::optional<Frame> last_;       ///< frame
    std::optional<Frame> last_step_;  ///< between the last two frames
    double product_ = 0.0, square_ = 0.0;
};

}  // namespace eyepoint::ig
