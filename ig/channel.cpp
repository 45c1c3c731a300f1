#include "ig/channel.hpp"

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "ig/control/frame_control.hpp"
#include "ig/control/timer_query_check.hpp"
#include "ig/egl_context.hpp"
#include "ig/frame_loop.hpp"
#include "ig/gpu_fence.hpp"
#include "ig/hud/hud.hpp"
#include "ig/output/outputs.hpp"
#include "ig/process_usage.hpp"
#include "terrain/database/database.hpp"
#include "terrain/geodesy/geoid.hpp"
#include "terrain/surface/surface_height.hpp"

namespace eyepoint::ig {

namespace {

template <typename Value>
using Expected = tl::expected<Value, std::string>;

/// Warm-up looks at the terrain from this far above the highest of it.
constexpr double kWarmUpClearanceM = 1000.0;

PictureSize picture_size(const config::ViewSettings& view) {
    return {static_cast<int>(view.width_px), static_cast<int>(view.height_px)};
}

/// The output's file or folder, made ready. Null for a window, which is opened with the OpenGL context.
Expected<std::unique_ptr<Output>> prepare_output(const config::Settings& settings) {
    const config::OutputSettings& output = settings.output;
    const bool to_disk =
        output.kind == config::OutputKind::Pictures || output.kind == config::OutputKind::Video;
    if (to_disk && output.path.empty()) {
        return tl::unexpected(
            std::string("no place for the output is set; give --output FOLDER or --video FILE"));
    }
    switch (output.kind) {
        case config::OutputKind::Window:
            return nullptr;
        case config::OutputKind::None:
            return std::make_unique<NoOutput>();
        case config::OutputKind::Pictures:
            return PictureFolder::open(output.path).map([&](PictureFolder folder) -> std::unique_ptr<Output> {
                return std::make_unique<PictureOutput>(std::move(folder), output.picture_every_s);
            });
        case config::OutputKind::Video:
            break;
    }
    return VideoPipe::start(
               {.file = output.path, .size = picture_size(settings.view), .rate_hz = settings.frame.rate_hz})
        .map([](VideoPipe pipe) -> std::unique_ptr<Output> {
            return std::make_unique<VideoOutput>(std::move(pipe));
        });
}

Expected<std::optional<FrameRecord>> prepare_record(const config::OutputSettings& output) {
    if (output.record.empty()) return std::nullopt;
    return FrameRecord::create(output.record).map([](FrameRecord record) {
        return std::optional{std::move(record)};
    });
}

/// Null where none is asked for.
Expected<std::unique_ptr<Trace>> prepare_trace(const config::OutputSettings& output) {
    if (output.trace.empty()) return nullptr;
    return Trace::create(output.trace);
}

Expected<std::optional<terrain::Geoid>> load_geoid(const config::Settings& settings) {
    if (settings.host.altitude_datum == config::VerticalDatum::Ellipsoid) return std::nullopt;
    const auto grid = settings.terrain.geoid.empty() ? terrain::Geoid::default_grid()
                                                     : std::filesystem::path(settings.terrain.geoid);
    return terrain::Geoid::load(grid).map(
        [](terrain::Geoid geoid) { return std::optional{std::move(geoid)}; });
}

Expected<std::shared_ptr<const terrain::Database>> open_database(const config::TerrainSettings& settings) {
    return terrain::Database::open(settings.database).map([](terrain::Database database) {
        return std::make_shared<const terrain::Database>(std::move(database));
    });
}

/// The OpenGL context, current, with or without a window.
struct Graphics {
    std::optional<EglContext> offscreen;
    std::optional<Window> window;

    [[nodiscard]] const GlIdentity& identity() const {
        return window ? window->identity() : offscreen->identity();
    }
};

Expected<Graphics> open_graphics(const config::Settings& settings, const ChannelSurroundings& surroundings) {
    Graphics graphics;
    if (settings.output.kind == config::OutputKind::Window) {
        auto window = Window::create({"Eyepoint", picture_size(settings.view), surroundings.gl_debug});
        if (!window) return tl::unexpected(window.error());
        graphics.window = *std::move(window);
    } else {
        auto context = EglContext::create(surroundings.gl_debug);
        if (!context) return tl::unexpected(context.error());
        graphics.offscreen = *std::move(context);
    }
    if (surroundings.gl_debug) log_gl_messages(surroundings.warn);
    return graphics;
}

Shading shading_of(config::Shading shading) {
    switch (shading) {
        case config::Shading::Forward:
            return Shading::Forward;
        case config::Shading::Deferred:
            return Shading::Deferred;
        case config::Shading::Automatic:
            break;
    }
    return Shading::Automatic;
}

Show show_of(config::Show show) {
    switch (show) {
        case config::Show::Wireframe:
            return Show::Wireframe;
        case config::Show::Levels:
            return Show::Levels;
        case config::Show::Terrain:
            break;
    }
    return Show::Terrain;
}

terrain::selective::Options selective_options(const config::LodSettings& lod) {
    using terrain::selective::ErrorFormula, terrain::selective::ReuseTest;
    constexpr std::array kReuseTests{ReuseTest::Sound, ReuseTest::FourCorner, ReuseTest::Off};
    return {lod.screen_error == config::ScreenError::Paper ? ErrorFormula::Paper : ErrorFormula::Bound,
            kReuseTests[static_cast<std::size_t>(lod.cache)]};
}

terrain::tiles::Options tile_options(const config::LodSettings& lod) {
    using terrain::tiles::MorphClock;
    constexpr std::array kPosts{9, 17, 33};
    constexpr std::array kClocks{MorphClock::Distance, MorphClock::Time, MorphClock::Frames};
    return {.posts = kPosts[static_cast<std::size_t>(lod.tile_posts)],
            .clock = kClocks[static_cast<std::size_t>(lod.morph_by)],
            .rebuilds = lod.rebuilds};
}

terrain::hyperblock::Options hyperblock_options(const config::LodSettings& lod) {
    using terrain::hyperblock::SelectBy;
    return {lod.hyper_select == config::HyperSelect::Vertex ? SelectBy::Vertex : SelectBy::Block,
            static_cast<int>(lod.hyper_level), lod.hyper_blocks_tau_px};
}

SceneOptions scene_options(const config::Settings& settings, const FrameTracks& tracks) {
    SceneOptions options;
    options.lod_method = settings.lod.method;
    options.triangle_budget = settings.lod.triangles;
    options.selective = selective_options(settings.lod);
    options.tile = tile_options(settings.lod);
    options.hyperblock = hyperblock_options(settings.lod);
    options.tau_px = settings.terrain.tau_px;
    options.slack = settings.lod.slack;
    options.morph = settings.lod.morph == config::Switch::On;
    options.shading = shading_of(settings.render.shading);
    options.show = show_of(settings.render.show);
    options.visibility_m = settings.environment.visibility_m;
    options.sun_azimuth_deg = settings.environment.sun_azimuth_deg;
    options.sun_elevation_deg = settings.environment.sun_elevation_deg;
    options.loader_threads = settings.terrain.loader_threads;
    options.block_cache_bytes = std::uint64_t{settings.terrain.cache_mib} << 20;
    options.tracks = tracks;
    return options;
}

/// None where it is not asked for and no key can. Without it a window is still worth opening.
Expected<std::optional<Hud>> prepare_hud(const config::Settings& settings,
                                         const ChannelSurroundings& surroundings) {
    const bool wanted = settings.render.hud == config::Switch::On;
    if (!wanted && settings.output.kind != config::OutputKind::Window) return std::nullopt;
    auto hud = Hud::create(picture_size(settings.view));
    if (hud) return std::optional{*std::move(hud)};
    if (wanted) return tl::unexpected(hud.error());
    surroundings.warn(hud.error());
    return std::nullopt;
}

/// Above the middle of the database's detail.
View warm_up_view(const terrain::Database& database, const config::ViewSettings& settings) {
    const terrain::GeographicExtent& extent = database.manifest().detail_extent;
    const double longitude_deg = (extent.west_deg + extent.east_deg) / 2.0;
    double top_m = 0.0;
    for (const std::uint32_t x : {0U, 1U}) {
        if (const auto* root = database.find({0, x, 0})) top_m = std::max<double>(top_m, root->height_max_m);
    }
    return neutral_view({(extent.south_deg + extent.north_deg) / 2.0, longitude_deg,
                         terrain::EllipsoidalHeight{top_m + kWarmUpClearanceM}},
                        settings, picture_size(settings));
}

}  // namespace

Expected<std::string> run_channel(const config::Settings& settings, const ChannelSurroundings& surroundings) {
    if (settings.terrain.database.empty()) {
        return tl::unexpected(
            std::string("no terrain database is given; use --terrain FOLDER, and make one with "
                        "'eyepoint-terrain synth -o FOLDER' if there is none"));
    }
    const auto control = control_target(settings);
    if (!control) return tl::unexpected(control.error());
    auto output = prepare_output(settings);
    if (!output) return tl::unexpected(output.error());
    auto record = prepare_record(settings.output);
    if (!record) return tl::unexpected(record.error());
    auto trace = prepare_trace(settings.output);
    if (!trace) return tl::unexpected(trace.error());
    auto host = net::HostLink::open({settings.host.address, settings.host.port, settings.host.answer_to});
    if (!host) return tl::unexpected(host.error());
    auto database = open_database(settings.terrain);
    if (!database) return tl::unexpected(database.error());
    auto geoid = load_geoid(settings);
    if (!geoid) return tl::unexpected(geoid.error());
    auto graphics = open_graphics(settings, surroundings);
    if (!graphics) return tl::unexpected(graphics.error());
    if (graphics->window) *output = std::make_unique<WindowOutput>(*graphics->window);
    auto frame_buffer = FrameBuffer::create(picture_size(settings.view));
    if (!frame_buffer) return tl::unexpected(frame_buffer.error());
    const FrameTracks tracks =
        *trace ? make_frame_tracks(**trace, settings.terrain.loader_threads) : FrameTracks{};
    auto scene = Scene::create(*database, scene_options(settings, tracks));
    if (!scene) return tl::unexpected(scene.error());

    auto hud = prepare_hud(settings, surroundings);
    if (!hud) return tl::unexpected(hud.error());

    frame_buffer->bind();
    const View first_view = warm_up_view(**database, settings.view);
    (*scene)->warm_up(first_view);
    if (*hud) (*hud)->draw(picture_size(settings.view));
    (void)wait_for_gpu();
    if (*control) surroundings.inform(describe(check_timer_queries([&] { (*scene)->draw(first_view); })));
    const GlIdentity& gl = graphics->identity();
    if (*record) {
        const std::string header = to_json_line(
            RecordHeader{surroundings.version, gl, picture_size(settings.view), settings.frame.rate_hz,
                         (*database)->manifest().name, settings.lod.method});
        if (auto added = (*record)->add(header); !added) return tl::unexpected(added.error());
    }
    surroundings.inform(fmt::format("ready: listening on {} port {}, {}x{} at {:g} Hz, terrain {}, {} ({})",
                                    settings.host.address, host->local_port(), settings.view.width_px,
                                    settings.view.height_px, settings.frame.rate_hz,
                                    settings.terrain.database, gl.renderer, gl.version));

    SystemClock clock;
    terrain::SurfaceHeight surface(*database);
    FrameLoop loop(settings,
                   {.scene = **scene,
                    .host = *host,
                    .output = **output,
                    .record = *record ? &**record : nullptr,
                    .hud = *hud ? &**hud : nullptr,
                    .clock = clock,
                    .geoid = *geoid ? &**geoid : nullptr,
                    .surface = &surface,
                    .control = *control,
                    .tracks = tracks,
                    .stop_requested = surroundings.stop_requested,
                    .warn = surroundings.warn},
                   *std::move(frame_buffer));
    const auto ended = loop.run();
    const std::string summary = loop.summary().line(loop.seconds(), host->counters(), peak_resident_bytes());
    if (!ended)
        return tl::unexpected(fmt::format("{} (after {} frames)", ended.error(), loop.summary().frames()));
    if (*trace) {
        if (auto finished = (*trace)->finish(); !finished) return tl::unexpected(finished.error());
    }
    return summary;
}

}  // namespace eyepoint::ig
