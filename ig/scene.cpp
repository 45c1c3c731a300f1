#include "ig/scene.hpp"

#include <optional>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "ig/lod_view.hpp"
#include "ig/process_usage.hpp"
#include "ig/render/floor_pass.hpp"
#include "ig/render/frame_uniforms.hpp"
#include "ig/render/resolve_pass.hpp"
#include "ig/render/shading_trial.hpp"
#include "ig/render/sky_pass.hpp"
#include "ig/render/still_mesh.hpp"
#include "ig/render/surface_buffer.hpp"
#include "ig/render/terrain_pass.hpp"
#include "terrain/lod/lod_method.hpp"
#include "terrain/pager/pager.hpp"

namespace eyepoint::ig {

namespace {

/// Finished blocks taken over in a frame: bounds the uploads that one frame can be asked for.
constexpr std::size_t kBlocksPublishedPerFrame = 128;
/// 170 blocks, some 10 MB: a horizon that is right to a kilometre or two, wherever the eye jumps.
constexpr std::uint32_t kBaseDepth = 3;

class TerrainScene final : public Scene {
  public:
    TerrainScene(std::unique_ptr<terrain::Pager> pager, std::unique_ptr<terrain::LodMethod> method,
                 TerrainPass terrain, ResolvePass resolve, FloorPass floor, SkyPass sky, SceneOptions options)
        : options_(std::move(options)),
          shading_(options_.shading),
          pager_(std::move(pager)),
          method_(std::move(method)),
          terrain_(std::move(terrain)),
          resolve_(std::move(resolve)),
          floor_(std::move(floor)),
          sky_(std::move(sky)) {
        glNamedBufferStorage(uniforms_.name(), sizeof(FrameUniforms), nullptr, GL_DYNAMIC_STORAGE_BIT);
    }

    void warm_up(const View& view) override;
    FrameStatistics draw(const View& view) override;
    void draw_floor(const View& view) override;
    void keep_still(const View& view) override;
    void draw_still(const View& view) override;
    void set_show(Show show) override { options_.show = show; }
    void set_tau(double tau_px) override { options_.tau_px = tau_px; }
    void set_time(double seconds) override { time_s_ = seconds; }
    [[nodiscard]] Shading shading() const override { return shading_; }
    std::uint64_t load_all(const View& view) override;
    std::vector<std::string> take_faults() override { return pager_->take_faults(); }

  private:
    void take_over_blocks();
    [[nodiscard]] const terrain::Selection& select(const View& view);
    [[nodiscard]] FrameStatistics upload(const terrain::Selection& selection);
    [[nodiscard]] terrain::LodView lod_view_of(const View& view) const;
    void begin(const View& view);
    void draw_terrain(const View& view, Shading shading);
    template <typename... Still>
    [[nodiscard]] bool raster_surface(const View& view, const Still&... still);
    void draw_shown(const View& view, const terrain::Selection& selection);

    SceneOptions options_;
    Shading shading_;
    std::unique_ptr<terrain::Pager> pager_;
    std::unique_ptr<terrain::LodMethod> method_;
    TerrainPass terrain_;
    SurfaceBuffer surface_;
    ResolvePass resolve_;
    FloorPass floor_;
    SkyPass sky_;
    GlBuffer uniforms_;
    std::uint64_t frame_ = 0;
    std::uint64_t drawn_frames_ = 0;
    double time_s_ = 0.0;
    const terrain::Selection* drawn_ = nullptr;  ///< the last draw's, until the next choice
    std::optional<StillMesh> still_;
};

terrain::LodView TerrainScene::lod_view_of(const View& view) const {
    terrain::LodView result = lod_view(view, options_.tau_px, options_.slack * options_.tau_px);
    result.time_s = time_s_;
    result.drawn_frame = drawn_frames_;
    return result;
}

/// Chooses what to draw from the blocks there are and wishes for the missing ones.
const terrain::Selection& TerrainScene::select(const View& view) {
    const Span span(options_.tracks.frame, "selection");
    ++frame_;
    drawn_ = nullptr;
    const terrain::Selection& selection = method_->select(lod_view_of(view), pager_->tree(), frame_);
    pager_->request(selection.wishes);
    return selection;
}

void TerrainScene::take_over_blocks() {
    const Span span(options_.tracks.frame, "taking over blocks");
    (void)pager_->publish(kBlocksPublishedPerFrame, frame_);
}

FrameStatistics TerrainScene::upload(const terrain::Selection& selection) {
    const Span span(options_.tracks.frame, "uploads");
    return terrain_.update(selection, frame_);
}

/// Uniforms, viewport, an empty picture, infinitely far (reverse Z: depth 0): magenta, or plain behind wires
/// and levels.
void TerrainScene::begin(const View& view) {
    const FrameUniforms uniforms = frame_uniforms(view, options_);
    glNamedBufferSubData(uniforms_.name(), 0, sizeof(uniforms), &uniforms);
    glBindBufferBase(GL_UNIFORM_BUFFER, 0, uniforms_.name());
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    glViewport(0, 0, view.width_px, view.height_px);
    if (options_.show == Show::Terrain || options_.sentinel) {
        glClearColor(1.0F, 0.0F, 1.0F, 1.0F);
    } else {
        glClearColor(0.80F, 0.86F, 0.93F, 1.0F);
    }
    glClearDepth(0.0);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

/// The raster pass of deferred shading; false where the target has no depth to share.
template <typename... Still>
bool TerrainScene::raster_surface(const View& view, const Still&... still) {
    if (!surface_.begin(view.width_px, view.height_px)) return false;
    terrain_.draw_surface(still...);
    surface_.end();
    return true;
}

/// A whole picture of the selection that the terrain pass has taken in.
void TerrainScene::draw_terrain(const View& view, Shading shading) {
    begin(view);
    if (shading == Shading::Deferred && raster_surface(view)) {
        resolve_.draw(surface_, terrain_.terrain(), terrain_.noise());
    } else {
        terrain_.draw();
    }
    if (!options_.sentinel) sky_.draw();
}

void TerrainScene::draw_shown(const View& view, const terrain::Selection& selection) {
    const Span span(options_.tracks.frame, "draw calls");
    switch (options_.show) {
        case Show::Terrain:
            if (shading_ == Shading::Automatic)
                shading_ = faster_shading([&](Shading shading) { draw_terrain(view, shading); });
            return draw_terrain(view, shading_);
        case Show::Wireframe:
            begin(view);
            return terrain_.draw_wireframe();
        case Show::Levels:
            begin(view);
            return terrain_.draw_levels(selection);
    }
}

void TerrainScene::warm_up(const View& view) {
    begin(view);
    (void)upload(select(view));
    terrain_.warm_up(false);
    if (options_.shading != Shading::Forward && surface_.begin(view.width_px, view.height_px)) {
        terrain_.warm_up(true);
        surface_.end();
        resolve_.warm_up(surface_, terrain_.terrain(), terrain_.noise());
    }
    sky_.draw();
}

FrameStatistics TerrainScene::draw(const View& view) {
    take_over_blocks();
    ++drawn_frames_;
    const double start_ms = thread_cpu_ms();
    const terrain::Selection& selection = select(view);
    const double selection_ms = thread_cpu_ms() - start_ms;

    FrameStatistics statistics = upload(selection);
    statistics.first_draw_ns = steady_now_ns();
    draw_shown(view, selection);
    drawn_ = &selection;
    statistics.selection_cpu_ms = selection_ms;
    statistics.loads_pending = static_cast<std::uint32_t>(pager_->pending());
    statistics.tau_px = options_.tau_px;
    return statistics;
}

void TerrainScene::draw_floor(const View& view) {
    begin(view);
    terrain_.draw_depth();
    if (terrain_.list().blocks() > 0)
        floor_.draw(terrain_.terrain(), terrain_.list().slot(0), terrain_.noise());
    if (!options_.sentinel) sky_.draw();
}

void TerrainScene::keep_still(const View& view) {
    const bool can = drawn_ != nullptr && terrain_.prepare_still();
    if (!can) return still_.reset();
    // The old mesh goes last: llvmpipe compiles shaders anew when names that it has seen come back as other
    // buffers.
    still_ = StillMesh{*drawn_, terrain_.list(), *method_, lod_view_of(view), options_.morph};
}

void TerrainScene::draw_still(const View& view) {
    begin(view);
    if (still_ && shading_ == Shading::Deferred && raster_surface(view, *still_)) {
        resolve_.draw(surface_, still_->terrain(), terrain_.noise());
    } else if (still_) {
        terrain_.draw(*still_);
    }
    if (!options_.sentinel) sky_.draw();
}

std::uint64_t TerrainScene::load_all(const View& view) {
    const std::uint64_t before = pager_->counters().loaded;
    constexpr std::size_t kAll = static_cast<std::size_t>(-1);
    while (true) {
        (void)pager_->publish(kAll, frame_);
        (void)select(view);
        if (!pager_->wait_for_loads()) break;
    }
    return pager_->counters().loaded - before;
}

}  // namespace

tl::expected<std::unique_ptr<Scene>, std::string> Scene::create(
    std::shared_ptr<const terrain::Database> database, const SceneOptions& options) {
    terrain::LodMethodOptions of_method{.cull = options.horizon_culling,
                                        .triangle_budget = options.triangle_budget,
                                        .selective = options.selective,
                                        .tile = options.tile,
                                        .hyperblock = options.hyperblock};
    of_method.tile.morph = options.morph;
    auto method = terrain::make_lod_method(options.lod_method, of_method);
    if (!method)
        return tl::unexpected(fmt::format("no LOD method is called '{}'; there is '{}'", options.lod_method,
                                          fmt::join(terrain::lod_method_names(), "', '")));
    return create(std::move(database), options, std::move(method));
}

tl::expected<std::unique_ptr<Scene>, std::string> Scene::create(
    std::shared_ptr<const terrain::Database> database, const SceneOptions& options,
    std::unique_ptr<terrain::LodMethod> method) {
    const bool nested = method->mesh_kind() == terrain::MeshKind::Nested;
    auto terrain = TerrainPass::create(*method);
    if (!terrain) return tl::unexpected(terrain.error());
    auto resolve = ResolvePass::create(nested);
    if (!resolve) return tl::unexpected(resolve.error());
    auto floor = FloorPass::create(nested);
    if (!floor) return tl::unexpected(floor.error());
    auto sky = SkyPass::create();
    if (!sky) return tl::unexpected(sky.error());
    auto pager = terrain::Pager::create(std::move(database), {.threads = options.loader_threads,
                                                              .mesh = method->mesh_kind(),
                                                              .cell_bounds = options.horizon_culling,
                                                              .cache_bytes = options.block_cache_bytes,
                                                              .base_depth = kBaseDepth,
                                                              .on_load = trace_loads(options.tracks)});
    if (!pager) return tl::unexpected(pager.error());
    return std::make_unique<TerrainScene>(std::move(*pager), std::move(method), std::move(*terrain),
                                          std::move(*resolve), std::move(*floor), std::move(*sky), options);
}

}  // namespace eyepoint::ig
