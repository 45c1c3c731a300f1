/// What is asked of OpenGL, counted from outside the renderer.
#pragma once

#include <cstdint>

namespace eyepoint::tools {

/// While one lives, the GL calls that Eyepoint makes go through counters: libepoxy's function pointers are
/// exchanged. Costs some 40 ns a call. Needs a current context that was made through EGL; at most one at a
/// time. Thread use: the context's thread.
class GlCensus {
  public:
    GlCensus();
    ~GlCensus();
    GlCensus(const GlCensus&) = delete;
    GlCensus& operator=(const GlCensus&) = delete;

    struct Count {
        double in_gl_ms = 0.0;          ///< wall time inside GL calls, waiting for fences included
        std::uint64_t calls = 0;        ///< of GL
        std::uint64_t programs = 0;     ///< linked
        std::uint64_t state_pairs = 0;  ///< different pairs of program and fixed-function state drawn with
    };
    /// Since it was made.
    [[nodiscard]] Count count() const;
};

}  // namespace eyepoint::tools
