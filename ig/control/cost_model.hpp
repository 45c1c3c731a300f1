/// What a frame costs against its triangles, learned from the frames as they come.
#pragma once

#include <cstdint>

namespace eyepoint::ig {

/// cost = fixed + per_triangle * triangles, both slowly changing. A Kalman filter of the two; all values are
/// ms.
///
/// While the number of triangles stands still only the sum can be seen. The filter then follows the sum and
/// keeps the split as it was last seen, growing less certain of it up to a bound; frames of other sizes tell
/// the split again. A frame far off the expectation is first taken for a spike and left out; a second one in
/// a row on the same side is a step of the load, which is learned at once, and so is a smaller one that a
/// few frames in a row agree on (a cumulative sum). Where the load goes back within a quarter of a second, as
/// after a burst of uploads, nothing is learned twice. Thread use: one thread.
class CostModel {
  public:
    /// What the newest frame was taken for.
    enum class Reading : std::uint8_t {
        Usual,
        First,    ///< nothing to compare it with
        Spike,    ///< left out
        Step,     ///< the load has changed: learned at once
        StepBack  ///< it has changed back soon after a step: what was known before holds again
    };

    /// triangles > 0, cost_ms > 0, both finite.
    Reading learn(double triangles, double cost_ms);

    [[nodiscard]] double cost_ms(double triangles) const { return fixed_ms() + terrain_ms(triangles); }
    /// What does not depend on the triangles: the pixels, the passes, the driver. At least 0.
    [[nodiscard]] double fixed_ms() const { return now_.fixed; }
    /// Grows with the triangles; above 0 once a frame is known.
    [[nodiscard]] double terrain_ms(double triangles) const { return now_.slope * load(triangles); }
    /// Standard deviation of terrain_ms(triangles).
    [[nodiscard]] double terrain_uncertainty_ms(double triangles) const;
    /// Standard deviation of cost_ms(triangles).
    [[nodiscard]] double uncertainty_ms(double triangles) const;
    /// Standard deviation of one frame's cost around the model, as a share of the cost.
    [[nodiscard]] double noise_share() const { return noise_share_; }

  private:
    struct Belief {
        double fixed = 0.0;                         ///< ms
        double slope = 0.0;                         ///< ms a load
        double p_ff = 0.0, p_fs = 0.0, p_ss = 0.0;  ///< covariance of the two
    };

    [[nodiscard]] double load(double triangles) const { return triangles / scale_triangles_; }
    void begin(double triangles, double cost_ms);
    [[nodiscard]] Reading judge(double load, double cost_ms);
    [[nodiscard]] double surprise(const Belief& belief, double load, double cost_ms) const;
    void learn_noise(double innovation_share);
    void forget(double share);
    void update(double load, double cost_ms);
    void keep_physical(double load, double cost_ms);

    double scale_triangles_ = 0.0;  ///< triangles of the first frame: load 1; 0 before it
    Belief now_;
    Belief before_step_;
    int frames_since_step_ = 0;
    double noise_share_ = 0.0;
    double above_ = 0.0, below_ = 0.0;  ///< cumulative sums of deviations to either side
};

}  // namespace eyepoint::ig
