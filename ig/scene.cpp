#include "ig/scene.hpp"

#include <ctime>
#include <utility>

#include <glm/geometric.hpp>

#include "ig/render/frame_uniforms.hpp"
#include "ig/render/sky_pass.hpp"
#include "ig/render/terrain_pass.hpp"
#include "terrain/lod/lod_method.hpp"
#include "terrain/pager/pager.hpp"

namespace eyepoint::ig {

namespace {

/// Finished blocks taken over in a frame: bounds the uploads that one frame can be asked for.
constexpr std::size_t kBlocksPublishedPerFrame = 128;

double thread_cpu_ms() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
}

terrain::LodView lod_view(const View& view, const SceneOptions& options) {
    const auto inward = [&](const glm::dvec3& normal) { return view.axes * glm::normalize(normal); };
    return {.eye = view.eye_ecef,
            .sides = {inward({1.0, 0.0, view.left}), inward({-1.0, 0.0, -view.right}),
                      inward({0.0, 1.0, view.bottom}), inward({0.0, -1.0, -view.top})},
            .kappa_px = view.pixels_per_radian(),
            .tau_px = options.tau_px,
            .near_m = view.near_m};
}

class TerrainScene final : public Scene {
  public:
    TerrainScene(std::unique_ptr<terrain::Pager> pager, std::unique_ptr<terrain::LodMethod> method,
                 TerrainPass terrain, SkyPass sky, SceneOptions options)
        : options_(std::move(options)),
          pager_(std::move(pager)),
          method_(std::move(method)),
          terrain_(std::move(terrain)),
          sky_(std::move(sky)) {
        glNamedBufferStorage(uniforms_.name(), sizeof(FrameUniforms), nullptr, GL_DYNAMIC_STORAGE_BIT);
    }

    void warm_up(const View& view) override;
    FrameStatistics draw(const View& view) override;
    std::uint64_t load_all(const View& view) override;
    std::vector<std::string> take_faults() override { return pager_->take_faults(); }

  private:
    [[nodiscard]] const terrain::Selection& select(const View& view);
    void begin(const View& view);

    SceneOptions options_;
    std::unique_ptr<terrain::Pager> pager_;
    std::unique_ptr<terrain::LodMethod> method_;
    TerrainPass terrain_;
    SkyPass sky_;
    GlBuffer uniforms_;
    std::uint64_t frame_ = 0;
};

/// Chooses what to draw from the blocks there are and wishes for the missing ones.
const terrain::Selection& TerrainScene::select(const View& view) {
    ++frame_;
    const terrain::Selection& selection = method_->select(lod_view(view, options_), pager_->tree(), frame_);
    pager_->request(selection.wishes);
    return selection;
}

/// Uniforms, viewport, an empty picture: magenta, infinitely far (reverse Z: depth 0).
void TerrainScene::begin(const View& view) {
    const FrameUniforms uniforms = frame_uniforms(view, options_);
    glNamedBufferSubData(uniforms_.name(), 0, sizeof(uniforms), &uniforms);
    glBindBufferBase(GL_UNIFORM_BUFFER, 0, uniforms_.name());
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    glViewport(0, 0, view.width_px, view.height_px);
    glClearColor(1.0F, 0.0F, 1.0F, 1.0F);
    glClearDepth(0.0);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

void TerrainScene::warm_up(const View& view) {
    begin(view);
    terrain_.warm_up(select(view), frame_);
    sky_.draw();
}

FrameStatistics TerrainScene::draw(const View& view) {
    (void)pager_->publish(kBlocksPublishedPerFrame, frame_);
    const double start_ms = thread_cpu_ms();
    const terrain::Selection& selection = select(view);
    const double selection_ms = thread_cpu_ms() - start_ms;

    begin(view);
    FrameStatistics statistics = terrain_.draw(selection, frame_);
    if (!options_.sentinel) sky_.draw();
    statistics.selection_cpu_ms = selection_ms;
    statistics.loads_pending = static_cast<std::uint32_t>(pager_->pending());
    statistics.tau_px = options_.tau_px;
    return statistics;
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
    auto method = terrain::make_lod_method(options.lod_method);
    if (!method)
        return tl::unexpected("no LOD method is called '" + options.lod_method + "'; there is 'regular'");
    auto terrain = TerrainPass::create(method->indices());
    if (!terrain) return tl::unexpected(terrain.error());
    auto sky = SkyPass::create();
    if (!sky) return tl::unexpected(sky.error());
    auto pager =
        terrain::Pager::create(std::move(database), {options.loader_threads, options.block_cache_bytes});
    if (!pager) return tl::unexpected(pager.error());
    return std::make_unique<TerrainScene>(std::move(*pager), std::move(method), std::move(*terrain),
                                          std::move(*sky), options);
}

}  // namespace eyepoint::ig
