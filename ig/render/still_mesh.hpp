/// A frame's triangles as one mesh that never changes: the measure of what level of detail costs.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "ig/render/draw_list.hpp"
#include "ig/render/drawn_terrain.hpp"
#include "ig/render/gl_objects.hpp"
#include "terrain/lod/lod_method.hpp"

namespace eyepoint::ig {

/// One vertex buffer, one index buffer, one draw a program. Vertices have the format of blocks and stand
/// where the view had them, so that every shader takes them as they are; a block keeps its own vertices and
/// its slot, triangles keep their order. What is painted on them is the list's, so it is good as long as the
/// list draws the same selection. Making one takes many frames' time.
class StillMesh {
  public:
    /// selection: what `list` was last updated with, of this method. view: with the tolerance that vertices
    /// of nested meshes move by (tau + slack).
    StillMesh(const terrain::Selection& selection, const DrawList& list, const terrain::LodMethod& method,
              const terrain::LodView& view, bool morph);

    [[nodiscard]] DrawnTerrain terrain() const;
    void draw_all() const;
    /// Those that need exactly this set of features; nothing where none do.
    void draw_features(std::size_t set) const;
    [[nodiscard]] bool has_features(std::size_t set) const { return parts_[set].count > 0; }

  private:
    /// Of the index buffer, in indices.
    struct Part {
        std::size_t first = 0;
        std::size_t count = 0;
        void draw() const;
    };

    GlBuffer vertices_;
    GlBuffer indices_;
    Part all_;
    std::array<Part, kFeatureSets> parts_;
    DrawnTerrain painted_;  ///< the list's
};

}  // namespace eyepoint::ig
