/// What a block's triangles err by because cells are split the other way than delta has them.
#pragma once

#include "terrain/database/database.hpp"

namespace eyepoint::terrain {

/// Greatest distance, along the vertical, between a block with all its posts whose cells are split every
/// other way, as bintrees and fans of right triangles have it, and one that is split as NodeInfo::delta_m has
/// it; metres.
[[nodiscard]] float twist_m(const BlockData& data);

}  // namespace eyepoint::terrain
