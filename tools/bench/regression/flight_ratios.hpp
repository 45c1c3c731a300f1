/// Figures of one run that hold on any machine, because both sides were measured beside each other.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "tools/bench/regression/block_bootstrap.hpp"
#include "tools/bench/regression/flight_result.hpp"

namespace eyepoint::tools {

/// A figure that can be taken of any choice of the frames that take part.
struct FlightRatio {
    std::string key;
    std::string what;                   ///< for people
    std::vector<std::uint32_t> frames;  ///< of the flight, from 0, that take part
    std::vector<double> series;         ///< by frame that takes part: what the figure is made of
    std::function<double(FrameChoice)>
        figure;  ///< of frames that take part, by place in `frames`; owns what it needs

    /// Of all frames that take part, with its interval.
    [[nodiscard]] Interval interval() const;
};

/// Those for which the result has columns:
///   price_of_lod          median over frames of process CPU over the CPU of the same triangles as a static
///   mesh p99_over_median       of process CPU a frame; and p999_over_median selection_over_frame  CPU of all
///   selection over process CPU of all frames
[[nodiscard]] std::vector<FlightRatio> flight_ratios(const FlightResult& result);

/// Times of a run, which compare on one machine alone: the medians of process CPU and of the frame thread's
/// time outside OpenGL, milliseconds.
[[nodiscard]] std::vector<FlightRatio> flight_times(const FlightResult& result);

/// Nearest rank of the chosen values; share 0..1.
[[nodiscard]] double percentile_of(const std::vector<double>& values, FrameChoice choice, double share);

}  // namespace eyepoint::tools
