/// What reading a frame back costs.
#pragma once

#include "ig/frame_buffer.hpp"

namespace eyepoint::tools {

/// Medians of wall times, milliseconds.
struct ReadbackTimes {
    double read_ms = 0.0;  ///< FrameBuffer::read() of a finished frame
    double copy_ms = 0.0;  ///< std::memcpy of as many bytes, from memory that was not read just before
};

/// Reads and copies by turns, so that both meet the same caches. Thread use: the context's thread.
[[nodiscard]] ReadbackTimes time_readback(const ig::FrameBuffer& frame_buffer);

}  // namespace eyepoint::tools
