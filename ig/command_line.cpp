#include "ig/command_line.hpp"

#include <memory>
#include <utility>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace eyepoint::ig {

namespace {

constexpr const char* kExamples =
    "Examples:\n"
    "  eyepoint --terrain world.db                              a window, FlightGear or JSBSim sending to "
    "port 5560\n"
    "  eyepoint --terrain world.db --headless --output pictures --end-after-silence 2\n"
    "  eyepoint --terrain world.db --headless --video flight.mp4 --rate 30 --size 1920x1080\n"
    "Settings come from built-in values, then --config, then EYEPOINT_SECTION_NAME variables, then flags.\n"
    "Exit status: 0 when the run ended as asked, also by Ctrl-C; 1 on any error, which one line explains.\n";

/// A flag that sets one key.
struct KeyFlag {
    const char* names;
    const char* key;
    const char* value_name;
    const char* description;
};

constexpr KeyFlag kKeyFlags[] = {
    {"-t,--terrain", "terrain.database", "FOLDER", "Terrain database"},
    {"--listen", "host.address", "ADDRESS", "Local address to listen on"},
    {"-p,--port", "host.port", "PORT", "UDP port to listen on"},
    {"-r,--rate", "frame.rate_hz", "HZ", "Frames a second"},
    {"--fov", "view.vertical_fov_deg", "DEGREES", "Vertical field of view, unless the host defines it"},
    {"-n,--frames", "frame.frames", "COUNT", "End after so many drawn frames"},
    {"--end-after-silence", "host.end_after_silence_s", "SECONDS",
     "End so long after the host's last packet"},
    {"--record", "output.record", "FILE", "Write the frame record, one JSON line a frame"},
    {"--trace", "output.trace", "FILE", "Write a trace of where the time goes, for ui.perfetto.dev"},
    {"--tau", "terrain.tau_px", "PIXELS", "Largest error of the drawn terrain"},
    {"--lod", "lod.method", "METHOD", "Level-of-detail method: nested, tile, bintree, selective, hyperblock"},
    {"--show", "render.show", "WHAT", "terrain, wireframe, or levels: a colour for every level of detail"},
};

std::string long_name(const std::string& names) { return names.substr(names.find("--")); }

/// Everything typed, as text, before it becomes overrides.
struct Typed {
    std::vector<std::pair<const KeyFlag*, std::string>> key_flags;
    std::string size, pictures, video;
    bool window = false, none = false, hud = false;
    std::vector<std::string> set;
};

void add_outputs(CLI::App& app, Typed& typed, CommandLine& line) {
    app.add_flag("--headless", line.headless, "Open no window");
    app.add_flag("-w,--window", typed.window, "Show frames in a window (the default)");
    app.add_option("-o,--output", typed.pictures, "Write numbered pictures")->type_name("FOLDER");
    app.add_option("-v,--video", typed.video, "Write a video (needs ffmpeg)")->type_name("FILE");
    app.add_flag("--none", typed.none, "Write and show nothing");
}

tl::expected<void, std::string> check_outputs(const Typed& typed, bool headless) {
    const int places = (typed.window ? 1 : 0) + (typed.none ? 1 : 0) + (typed.pictures.empty() ? 0 : 1) +
                       (typed.video.empty() ? 0 : 1);
    if (places > 1) return tl::unexpected(std::string("give one of --window, --output, --video and --none"));
    if (headless && typed.window) return tl::unexpected(std::string("give one of --headless and --window"));
    return {};
}

void add_options(CLI::App& app, Typed& typed, CommandLine& line) {
    for (const KeyFlag& flag : kKeyFlags) {
        app.add_option_function<std::string>(
               flag.names,
               [&typed, &flag](const std::string& value) { typed.key_flags.emplace_back(&flag, value); },
               flag.description)
            ->type_name(flag.value_name)
            ->take_last();
    }
    app.add_option("-c,--config", line.config_file, "Settings file (TOML)")->type_name("FILE");
    app.add_option("-s,--size", typed.size, "Size of the picture, pixels")->type_name("WIDTHxHEIGHT");
    app.add_option("--set", typed.set, "Any setting, by its name in the file")
        ->type_name("SECTION.NAME=VALUE")
        ->expected(1)
        ->take_all();
    app.add_flag("--hud", typed.hud, "Draw figures and graphs of the run over the picture");
    app.add_flag("--print-config", line.print_config,
                 "Print the settings in force and where each came from, and end");
    app.add_flag("--gl-debug", line.gl_debug, "Log what the graphics driver has to say");
}

tl::expected<void, std::string> take_size(const std::string& text, std::vector<config::Override>& overrides) {
    if (text.empty()) return {};
    const auto cross = text.find('x');
    if (cross == std::string::npos) {
        return tl::unexpected(
            fmt::format("--size {}: expected WIDTHxHEIGHT in pixels, such as 1280x720", text));
    }
    overrides.push_back({"view.width_px", text.substr(0, cross), "--size"});
    overrides.push_back({"view.height_px", text.substr(cross + 1), "--size"});
    return {};
}

tl::expected<void, std::string> take_set(const std::string& text, std::vector<config::Override>& overrides) {
    const auto equals = text.find('=');
    if (equals == std::string::npos) {
        return tl::unexpected(
            fmt::format("--set {}: expected SECTION.NAME=VALUE, such as terrain.tau_px=2", text));
    }
    overrides.push_back({text.substr(0, equals), text.substr(equals + 1), fmt::format("--set {}", text)});
    return {};
}

void take_output(const Typed& typed, std::vector<config::Override>& overrides) {
    if (typed.window) overrides.push_back({"output.kind", "window", "--window"});
    if (typed.none) overrides.push_back({"output.kind", "none", "--none"});
    if (!typed.pictures.empty()) {
        overrides.push_back({"output.kind", "pictures", "--output"});
        overrides.push_back({"output.path", typed.pictures, "--output"});
    }
    if (!typed.video.empty()) {
        overrides.push_back({"output.kind", "video", "--video"});
        overrides.push_back({"output.path", typed.video, "--video"});
    }
}

tl::expected<std::vector<config::Override>, std::string> overrides_of(const Typed& typed) {
    std::vector<config::Override> overrides;
    for (const std::string& setting : typed.set) {
        if (auto taken = take_set(setting, overrides); !taken) return tl::unexpected(taken.error());
    }
    for (const auto& [flag, value] : typed.key_flags)
        overrides.push_back({flag->key, value, long_name(flag->names)});
    if (auto taken = take_size(typed.size, overrides); !taken) return tl::unexpected(taken.error());
    if (typed.hud) overrides.push_back({"render.hud", "on", "--hud"});
    take_output(typed, overrides);
    return overrides;
}

}  // namespace

tl::expected<CommandLine, std::string> parse_command_line(int argc, const char* const* argv,
                                                          const std::string& version) {
    CommandLine line;
    Typed typed;
    CLI::App app{"Eyepoint image generator: draws what a flight simulator's eyepoint sees of the Earth",
                 "eyepoint"};
    app.footer(kExamples);
    app.set_version_flag("-V,--version", "eyepoint " + version);
    add_options(app, typed, line);
    add_outputs(app, typed, line);
    try {
        app.parse(argc, argv);
    } catch (const CLI::CallForHelp&) {
        line.answer = app.help();
        return line;
    } catch (const CLI::CallForVersion& asked) {
        line.answer = std::string(asked.what()) + "\n";
        return line;
    } catch (const CLI::ParseError& fault) {
        return tl::unexpected(fmt::format("{}; see eyepoint --help", fault.what()));
    }
    if (auto checked = check_outputs(typed, line.headless); !checked) return tl::unexpected(checked.error());
    auto overrides = overrides_of(typed);
    if (!overrides) return tl::unexpected(overrides.error());
    line.overrides = *std::move(overrides);
    return line;
}

tl::expected<config::LoadedSettings, std::string> load_settings(const CommandLine& command_line) {
    config::LoadRequest request{command_line.config_file, config::process_environment(),
                                command_line.overrides};
    auto loaded = config::load(request);
    if (!loaded || !command_line.headless || loaded->settings.output.kind != config::OutputKind::Window)
        return loaded;
    request.overrides.push_back({"output.kind", "none", "--headless"});
    return config::load(request);
}

}  // namespace eyepoint::ig
