#include "terrain/lod/lod_method.hpp"

#include "terrain/lod/bintree/bintree_lod.hpp"
#include "terrain/lod/hyperblock/hyperblock_lod.hpp"
#include "terrain/lod/nested.hpp"
#include "terrain/lod/selective/selective_lod.hpp"
#include "terrain/lod/tile/tile_lod.hpp"

namespace eyepoint::terrain {

namespace {
constexpr std::array<std::string_view, 5> kNames{"nested", "tile", "bintree", "selective", "hyperblock"};
}  // namespace

std::span<const std::string_view> lod_method_names() { return kNames; }

std::unique_ptr<LodMethod> make_lod_method(std::string_view name, const LodMethodOptions& options) {
    if (name == kNames[0]) return std::make_unique<NestedLod>(true, options.cull);
    if (name == kNames[1]) return std::make_unique<TileLod>(options.tile);
    if (name == kNames[2]) return std::make_unique<BintreeLod>(options.triangle_budget);
    if (name == kNames[3]) return std::make_unique<SelectiveLod>(options.selective);
    if (name == kNames[4]) return std::make_unique<HyperblockLod>(options.hyperblock);
    return nullptr;
}

}  // namespace eyepoint::terrain
