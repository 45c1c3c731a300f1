/// What of the method of Larsen & Christensen can be chosen.
#pragma once

#include <cstdint>

namespace eyepoint::terrain::tiles {

/// What moves the slide between two levels on (2.3).
enum class MorphClock : std::uint8_t {
    Distance,  ///< the eye's way, as a share of its distance from the tile: a still eye sees still terrain
    Time,      ///< seconds
    Frames     ///< drawn frames
};

struct Options {
    int posts = 33;     ///< of a tile, a side: 9, 17 or 33
    bool morph = true;  ///< otherwise levels switch at once
    MorphClock clock = MorphClock::Distance;
    /// Tiles that may change to another level's mesh in a frame, while morphs are on; the rest waits. The
    /// paper's is 1.
    std::uint32_t rebuilds = 16;
};

}  // namespace eyepoint::terrain::tiles
