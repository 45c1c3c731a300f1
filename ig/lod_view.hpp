/// What a level-of-detail method must know of a view.
#pragma once

#include "ig/view.hpp"
#include "terrain/lod/lod_method.hpp"

namespace eyepoint::ig {

/// tau_px: tolerance; slack_px: what a choice once made may use on top of it.
[[nodiscard]] terrain::LodView lod_view(const View& view, double tau_px, double slack_px);

}  // namespace eyepoint::ig
