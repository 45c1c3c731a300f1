/// One channel: a process's whole run, from settings to summary.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include <tl/expected.hpp>

#include "config/settings.hpp"

namespace eyepoint::ig {

/// What a run needs beside its settings.
struct ChannelSurroundings {
    std::string version;    ///< of the program, for the frame record
    bool gl_debug = false;  ///< a debug context, its messages going to `warn`
    std::function<bool()> stop_requested;
    std::function<void(std::string_view)> inform;
    std::function<void(std::string_view)> warn;
};

/// Starts and runs a channel: settings are checked, the output is made ready, the port bound, the database
/// opened, the OpenGL context and the scene made and warmed up; then `inform` is given a line that begins
/// with "ready:" and names the port, and the frame loop runs. Returns the summary of the run. On failure: one
/// sentence with the remedy; until "ready" nothing has been drawn. Thread use: the main thread.
[[nodiscard]] tl::expected<std::string, std::string> run_channel(const config::Settings& settings,
                                                                 const ChannelSurroundings& surroundings);

}  // namespace eyepoint::ig
