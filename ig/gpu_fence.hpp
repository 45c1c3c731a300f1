/// Waiting for the GPU.
#pragma once

namespace eyepoint::ig {

/// Returns when everything asked of the current context so far is done: true, or false when that is still not
/// so after ten seconds or the context is lost. A fence and the monotonic clock measure drawing; GL timer
/// queries do not (on Mesa's software renderer they see a fraction of the work).
[[nodiscard]] bool wait_for_gpu();

}  // namespace eyepoint::ig
