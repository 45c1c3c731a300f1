#include "ig/trace/frame_tracks.hpp"

#include <chrono>

#include <fmt/format.h>

namespace eyepoint::ig {

namespace {

std::int64_t in_ns(std::chrono::steady_clock::time_point time) {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(time.time_since_epoch()).count();
}

}  // namespace

FrameTracks make_frame_tracks(Trace& trace, unsigned loader_threads) {
    FrameTracks tracks{trace.track("frame thread"), trace.track("GPU"), {}};
    for (unsigned i = 1; i <= loader_threads; ++i)
        tracks.loaders.push_back(trace.track(fmt::format("loader {}", i)));
    return tracks;
}

std::function<void(const terrain::BlockLoad&)> trace_loads(const FrameTracks& tracks) {
    if (tracks.loaders.empty()) return {};
    return [loaders = tracks.loaders](const terrain::BlockLoad& load) {
        const SpanNumbers tile{{{"depth", load.tile.depth}, {"x", load.tile.x}, {"y", load.tile.y}}};
        const Track& track = loaders.at(load.thread);
        if (load.stored) track.add({"read", in_ns(load.began), in_ns(load.read), tile});
        track.add(load.stored
                      ? SpanRecord{"unfold", in_ns(load.read), in_ns(load.done), tile}
                      : SpanRecord{"make from the parent", in_ns(load.began), in_ns(load.done), tile});
    };
}

}  // namespace eyepoint::ig
