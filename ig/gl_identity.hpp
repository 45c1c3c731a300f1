/// What the current OpenGL context is, and whether it can carry Eyepoint.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include <tl/expected.hpp>

namespace eyepoint::ig {

struct GlIdentity {
    std::string renderer;  ///< GL_RENDERER
    std::string version;   ///< GL_VERSION

    bool operator==(const GlIdentity&) const = default;
};

/// Identity of the current context. On failure (older than OpenGL 4.5, or no GL_ARB_clip_control, which
/// reverse-Z stands on): one sentence with what there is and the remedy.
[[nodiscard]] tl::expected<GlIdentity, std::string> check_current_context();

/// Gives every message of a debug context, notifications left out, to `log`, on the thread that made the GL
/// call. `log` must live as long as the context.
void log_gl_messages(const std::function<void(std::string_view)>& log);

}  // namespace eyepoint::ig
