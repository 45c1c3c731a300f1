#include "terrain/lod/lod_method.hpp"

#include "terrain/lod/nested.hpp"
#include "terrain/lod/regular.hpp"

namespace eyepoint::terrain {

namespace {
constexpr std::array<std::string_view, 2> kNames{"nested", "regular"};
}  // namespace

std::span<const std::string_view> lod_method_names() { return kNames; }

std::unique_ptr<LodMethod> make_lod_method(std::string_view name, bool cull) {
    if (name == kNames[0]) return std::make_unique<NestedLod>(true, cull);
    if (name == kNames[1]) return std::make_unique<RegularLod>();
    return nullptr;
}

}  // namespace eyepoint::terrain
