/// Which way of shading is faster here: measured, not guessed.
#pragma once

#include <functional>

#include "ig/shading.hpp"

namespace eyepoint::ig {

/// Draws a view a few times each way, by turns, and returns the way with the lower median. Time is from the
/// first call to the fence after the last, by the monotonic clock: on a software renderer GL's timer queries
/// see a fraction of it. `draw` draws a whole frame that way; it needs what it draws to be on the card.
[[nodiscard]] Shading faster_shading(const std::function<void(Shading)>& draw);

}  // namespace eyepoint::ig
