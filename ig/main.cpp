/// eyepoint: the image generator.
#include <cstdlib>
#include <exception>

#include <fmt/format.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include "ig/channel.hpp"
#include "ig/command_line.hpp"
#include "ig/signals.hpp"

namespace {

using namespace eyepoint;

int fail(const std::string& sentence) {
    fmt::print(stderr, "eyepoint: {}\n", sentence);
    return EXIT_FAILURE;
}

int answer(const std::string& text) {
    fmt::print("{}", text);
    return EXIT_SUCCESS;
}

int fly(const config::Settings& settings, bool gl_debug) {
    const ig::StopSignals signals;
    const ig::ChannelSurroundings surroundings{
        .version = EYEPOINT_VERSION,
        .gl_debug = gl_debug,
        .stop_requested = ig::StopSignals::requested,
        .inform = [](std::string_view line) { spdlog::info("{}", line); },
        .warn = [](std::string_view line) { spdlog::warn("{}", line); },
    };
    const auto summary = ig::run_channel(settings, surroundings);
    return summary ? answer(*summary + "\n") : fail(summary.error());
}

int run(int argc, const char* const* argv) {
    spdlog::set_default_logger(spdlog::stderr_color_mt("eyepoint"));
    spdlog::set_pattern("%Y-%m-%dT%H:%M:%S.%e %n %^%l%$: %v");
    const auto command_line = ig::parse_command_line(argc, argv, EYEPOINT_VERSION);
    if (!command_line) return fail(command_line.error());
    if (command_line->answer) return answer(*command_line->answer);
    const auto loaded = ig::load_settings(*command_line);
    if (!loaded) return fail(loaded.error());
    if (command_line->print_config) return answer(config::print(*loaded));
    return fly(loaded->settings, command_line->gl_debug);
}

}  // namespace

int main(int argc, char** argv) {
    try {
        return run(argc, argv);
    } catch (const std::exception& fault) {
        return fail(fmt::format("unexpected fault: {}", fault.what()));
    }
}
