/// The scene: terrain, sky and light drawn for a view into the bound framebuffer. Needs a current OpenGL 4.5
/// core context; one thread. Deferred shading needs that framebuffer to have a depth renderbuffer; without
/// one, shading is forward.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <glm/vec3.hpp>
#include <tl/expected.hpp>

#include "ig/frame_statistics.hpp"
#include "ig/shading.hpp"
#include "ig/trace/frame_tracks.hpp"
#include "ig/view.hpp"
#include "terrain/lod/hyperblock/hyperblock_options.hpp"
#include "terrain/lod/selective/selective_options.hpp"
#include "terrain/lod/tile/tile_options.hpp"

namespace eyepoint::terrain {
class Database;
class LodMethod;
}  // namespace eyepoint::terrain

namespace eyepoint::ig {

struct SceneOptions {
    std::string lod_method = "nested";          ///< see terrain::lod_method_names()
    double tau_px = 1.0;                        ///< tolerance, pixels
    std::uint32_t triangle_budget = 0;          ///< terrain::LodMethodOptions
    terrain::selective::Options selective{};    ///< terrain::LodMethodOptions
    terrain::tiles::Options tile{};             ///< terrain::LodMethodOptions; `morph` is below
    terrain::hyperblock::Options hyperblock{};  ///< terrain::LodMethodOptions
    double slack = 0.1;  ///< s as a share of tau: what a choice of level once made may exceed tau by
    bool morph = true;   ///< vertices slide from level to level; otherwise they jump
    bool horizon_culling = false;  ///< leave out what nearer terrain hides: the same picture; nested alone
    Shading shading = Shading::Automatic;
    Show show = Show::Terrain;
    double visibility_m = 100000.0;   ///< meteorological: contrast 2% at this distance, at sea level
    double sun_azimuth_deg = 150.0;   ///< from true north, at the eye
    double sun_elevation_deg = 32.0;  ///< above the horizon, at the eye
    unsigned loader_threads = 1;
    std::uint64_t block_cache_bytes = 512ULL << 20;
    FrameTracks tracks{};   ///< told of selection, uploads, draw calls and loads; they outlive the scene
    bool sentinel = false;  ///< test aid: no sky, the clear colour stays where no terrain is drawn
};

class Scene {
  public:
    /// On failure: one sentence.
    [[nodiscard]] static tl::expected<std::unique_ptr<Scene>, std::string> create(
        std::shared_ptr<const terrain::Database> database, const SceneOptions& options);
    /// With a method made by the caller; the one that the options name is not looked at.
    [[nodiscard]] static tl::expected<std::unique_ptr<Scene>, std::string> create(
        std::shared_ptr<const terrain::Database> database, const SceneOptions& options,
        std::unique_ptr<terrain::LodMethod> method);
    virtual ~Scene() = default;

    /// Draws every program and state pair once, at the view's size, so that no later frame pays for a first
    /// use.
    virtual void warm_up(const View& view) = 0;
    /// Draws one frame of the newest terrain there is; never waits for a load. Where shading is automatic the
    /// first frame is drawn a few times more, to choose it.
    virtual FrameStatistics draw(const View& view) = 0;
    /// What any renderer of the same mesh must do at least, to measure draw() against: the last draw()'s
    /// triangles with depth alone, then the terrain's shader and the sky once a pixel. Not a picture of the
    /// terrain: its depth, but a plain's shading.
    virtual void draw_floor(const View& view) = 0;
    /// Keeps the last draw()'s triangles, where they were drawn, as one static mesh: for measuring, as it
    /// takes many frames' time. To be called after a draw() of the same view, before anything else.
    virtual void keep_still(const View& view) = 0;
    /// The mesh kept, with the passes and shaders of draw() and none of its level of detail, in the vertex
    /// shader neither: what draw() costs more is the price of that. Nothing kept: the sky.
    virtual void draw_still(const View& view) = 0;
    /// From the next frame on.
    virtual void set_show(Show show) = 0;
    /// Pixels, above 0, from the next frame on; the slack keeps its share of it. Choices of level that are
    /// still right for the new tolerance are kept.
    virtual void set_tau(double tau_px) = 0;
    /// When the next frame is, for what is animated by time. It does not go back.
    virtual void set_time(double seconds) = 0;
    /// The one in force; Automatic until the first frame has chosen.
    [[nodiscard]] virtual Shading shading() const = 0;
    /// Loads, waiting, until nothing that the view asks for is missing (or cannot be read): for tests,
    /// pictures and virtual time. Returns the number of blocks loaded.
    virtual std::uint64_t load_all(const View& view) = 0;

    /// Sentences about tiles that could not be read since the last call, each tile once; an ancestor is drawn
    /// there.
    [[nodiscard]] virtual std::vector<std::string> take_faults() = 0;
};

}  // namespace eyepoint::ig
