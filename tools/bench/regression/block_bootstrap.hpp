/// Confidence intervals for figures of a flight's frames, which follow one another and are not independent.
#pragma once

#include <cstdint>
#include <functional>
#include <span>

namespace eyepoint::tools {

struct Interval {
    double value = 0.0;
    double low = 0.0;
    double high = 0.0;
};

/// Frames to take a figure of, by number; some more than once.
using FrameChoice = std::span<const std::uint32_t>;

/// The 95% interval of a figure of `frames` frames, by the stationary bootstrap: the figure is taken of 1000
/// flights of the same length, each put together of runs of successive frames (the last followed by the
/// first) that begin anywhere and have geometrically distributed lengths with the given mean (at least 1);
/// the interval is their 2.5% and 97.5% percentiles. Two flights are compared by a figure of both at the same
/// frames. Equal arguments give the same interval. D. N. Politis, J. P. Romano: The stationary bootstrap,
/// Journal of the American Statistical Association 89 (1994) 1303-1313.
[[nodiscard]] Interval bootstrap(std::size_t frames, double mean_run,
                                 const std::function<double(FrameChoice)>& figure);

/// The mean length of runs that suits a series: D. N. Politis, H. White: Automatic block-length selection for
/// the dependent bootstrap, Econometric Reviews 23 (2004) 53-70, with the correction of A. Patton, D. N.
/// Politis, H. White in 28 (2009) 372-375. 1 for a series without memory; at most a third of its length and 3
/// of its square roots.
[[nodiscard]] double mean_run_length(std::span<const double> series);

}  // namespace eyepoint::tools
