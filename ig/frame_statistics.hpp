/// What drawing one frame took; the renderer's part of the frame record.
#pragma once

#include <cstdint>

namespace eyepoint::ig {

struct FrameStatistics {
    std::uint64_t triangles = 0;
    std::uint64_t triangles_hidden = 0;  ///< left out because nearer terrain hides them
    std::uint32_t draws = 0;
    std::uint32_t blocks_drawn = 0;
    std::uint32_t blocks_tested = 0;
    std::uint32_t blocks_reused = 0;  ///< of them: the choice of an earlier frame stood
    std::uint32_t loads_pending = 0;
    std::uint32_t blocks_uploaded = 0;
    std::uint64_t bytes_uploaded = 0;
    double selection_cpu_ms = 0.0;
    double tau_px = 0.0;
    std::int64_t first_draw_ns = 0;  ///< steady clock, when the first draw was asked for
};

}  // namespace eyepoint::ig
