/// Draws a selection of blocks, in each of the ways there are.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "ig/frame_statistics.hpp"
#include "ig/render/draw_list.hpp"
#include "ig/render/drawn_terrain.hpp"
#include "ig/render/gl_objects.hpp"
#include "ig/render/still_mesh.hpp"
#include "terrain/lod/lod_method.hpp"

namespace eyepoint::ig {

/// All draws need the frame's uniforms bound.
class TerrainPass {
  public:
    [[nodiscard]] static tl::expected<TerrainPass, std::string> create(const terrain::LodMethod& method);

    /// Takes in a selection: uploads what is not on the card yet. Fills in triangles, blocks and uploads of
    /// the statistics it returns.
    [[nodiscard]] FrameStatistics update(const terrain::Selection& selection, std::uint64_t frame);
    [[nodiscard]] const DrawList& list() const { return list_; }
    /// The last update's selection on the card.
    [[nodiscard]] DrawnTerrain terrain() const;

    /// The last update's selection, shaded.
    void draw() const;
    /// What shading needs of it, into the bound SurfaceBuffer.
    void draw_surface() const;
    /// Makes what the next two need; false where that fails.
    [[nodiscard]] bool prepare_still();
    /// The same two of a mesh that stands still: the same programs, without what moves vertices.
    void draw(const StillMesh& mesh) const;
    void draw_surface(const StillMesh& mesh) const;
    /// Its depth alone.
    void draw_depth() const;
    /// One triangle with every program of those, so that no later frame pays for a first use. The target must
    /// be one for draw() or, where `surface`, a SurfaceBuffer.
    void warm_up(bool surface) const;

    /// The selection as lines, hidden ones left out.
    void draw_wireframe() const;
    /// Each draw in a colour: hue by its level, brightness by its tile's depth. The selection is the last
    /// update's.
    void draw_levels(const terrain::Selection& selection) const;

    /// The noise that ground is varied with.
    [[nodiscard]] GLuint noise() const { return noise_.name(); }

  private:
    struct Programs {
        std::vector<GlProgram> shaded;  ///< by set of features
        std::vector<GlProgram> others;  ///< by Other
    };
    enum Other : std::size_t { kSurface, kDepth, kShown };

    /// How a program moves vertices; not at all: false and 0.
    struct Motion {
        bool nested = false;
        int sliding_parts = 0;  ///< LodMethod's
    };

    [[nodiscard]] static tl::expected<Programs, std::string> link(bool nested, const Motion& motion);
    TerrainPass(Programs programs, std::optional<Programs> sliding, const terrain::LodMethod& method);
    static void draw_shaded(const Programs& programs, const SortedCommands& commands);
    void draw_each(Other program) const;
    void describe_vertices() const;
    void begin(const DrawnTerrain& terrain) const;
    [[nodiscard]] const Programs& still_programs() const { return nested_ ? *motionless_ : programs_; }
    /// For draws whose vertices slide or do not.
    [[nodiscard]] const Programs& moving_programs() const { return sliding_ ? *sliding_ : programs_; }

    Programs programs_;
    std::optional<Programs> sliding_;     ///< of a method with tiles that slide, for those that do
    std::optional<Programs> motionless_;  ///< of nested meshes
    bool nested_;
    GlVertexArray layout_;
    std::optional<GlBuffer> shared_indices_;  ///< of a method with one list for all draws
    GlTexture noise_;
    DrawList list_;
};

}  // namespace eyepoint::ig
