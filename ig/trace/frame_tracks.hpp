/// The tracks of one channel's trace.
#pragma once

#include <vector>

#include "ig/trace/trace.hpp"
#include "terrain/pager/pager.hpp"

namespace eyepoint::ig {

/// As values: made by default, nothing is traced.
struct FrameTracks {
    Track frame;                 ///< the frame's thread
    Track gpu;                   ///< spans from a frame's first draw to its fence, told by the frame's thread
    std::vector<Track> loaders;  ///< the pager's threads
};

[[nodiscard]] FrameTracks make_frame_tracks(Trace& trace, unsigned loader_threads);

/// What hears of a pager's loads and tells them to the loaders' tracks; empty where there are none.
[[nodiscard]] std::function<void(const terrain::BlockLoad&)> trace_loads(const FrameTracks& tracks);

}  // namespace eyepoint::ig
