/// A level-of-detail method flown along a row of eyes: post error, pops, cracks and work, frame by frame.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "terrain/lod/selective/selective_lod.hpp"
#include "tools/bench/measure/flight.hpp"
#include "tools/bench/measure/mesh_faults.hpp"
#include "tools/bench/measure/post_error.hpp"

namespace eyepoint::tools {

struct MeasureOptions {
    std::size_t every = 1;    ///< frames: of every so-manieth one the mesh is measured
    double far_m = 120000.0;  ///< posts beyond are not looked at
    bool morph = true;        ///< as in terrain::motion_view()
    bool posts = true;        ///< measure post error
    bool pops = true;         ///< measure jumps between each measured frame and the one before it
    bool faults = true;       ///< look for cracks
};

/// One frame. What selection took is known of every frame; the rest of measured ones.
struct FrameMeasure {
    std::size_t frame = 0;  ///< its eye's number
    std::uint64_t triangles = 0;
    std::uint64_t triangles_hidden = 0;
    std::uint32_t draws = 0;
    std::uint32_t blocks_drawn = 0;
    std::uint32_t blocks_tested = 0;
    std::uint32_t blocks_reused = 0;
    std::uint32_t blocks_chosen = 0;
    SelectionWork work;
    bool measured = false;
    std::uint64_t empty_triangles = 0;  ///< of `triangles`: slid shut
    PostFigures posts;
    PixelDistribution pops;
    MeshFaults faults;
    terrain::SelectionAudit audit;  ///< selective alone
};

/// Called for measured frames, with what post error was worked out from.
using SeePosts = std::function<tl::expected<void, std::string>(std::size_t frame, const PostView& view,
                                                               const MeasuredPosts& posts)>;

/// Flies the views in order. The first lap loads all that they ask for, the second is measured: so selection
/// is as in steady flight, each frame after the one before it, with nothing missing. On failure: one
/// sentence.
[[nodiscard]] tl::expected<std::vector<FrameMeasure>, std::string> measure_flight(
    LodFlight& flight, FullSurface& surface, std::span<const terrain::LodView> views,
    const MeasureOptions& options, const SeePosts& see = {});

/// A flight's figures in sum.
struct FlightFigures {
    std::size_t frames = 0;
    std::size_t measured_frames = 0;
    double triangles_mean = 0.0, triangles_median = 0.0;
    std::uint64_t triangles_max = 0;
    double draws_mean = 0.0;
    double blocks_drawn_mean = 0.0;
    double hidden_mean = 0.0;
    double empty_mean = 0.0;  ///< of measured frames
    double tested_mean = 0.0;
    double reused_share = 0.0;  ///< of those chosen anew or reused
    double selection_us_mean = 0.0, selection_us_median = 0.0;
    double ns_per_block = 0.0;            ///< tested, over all frames
    double median_ns_per_block = 0.0;     ///< of the frames
    std::uint64_t allocations = 0;        ///< in all frames but the first
    std::uint64_t frames_allocating = 0;  ///< of them: with any
    double uploaded_kib_mean = 0.0;
    std::uint64_t frames_wishing = 0;  ///< something was not loaded
    PostFigures posts;
    double worst_frame_p999_px = 0.0;
    PixelDistribution pops;
    MeshFaults faults;
    terrain::SelectionAudit audit;  ///< of measured frames, in sum
};
[[nodiscard]] FlightFigures summarise(std::span<const FrameMeasure> frames);

}  // namespace eyepoint::tools
