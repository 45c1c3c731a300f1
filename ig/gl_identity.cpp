#include "ig/gl_identity.hpp"

#include <epoxy/gl.h>
#include <fmt/format.h>

namespace eyepoint::ig {

namespace {

constexpr int kNeededGlVersion = 45;

std::string gl_string(GLenum name) {
    const GLubyte* text = glGetString(name);
    return text == nullptr ? "unknown" : reinterpret_cast<const char*>(text);
}

void GLAPIENTRY forward_message(GLenum, GLenum, GLuint, GLenum severity, GLsizei length, const GLchar* text,
                                const void* log) {
    if (severity == GL_DEBUG_SEVERITY_NOTIFICATION) return;
    const std::string_view message{text, static_cast<std::size_t>(length)};
    (*static_cast<const std::function<void(std::string_view)>*>(log))(message);
}

}  // namespace

tl::expected<GlIdentity, std::string> check_current_context() {
    GlIdentity identity{gl_string(GL_RENDERER), gl_string(GL_VERSION)};
    const int version = epoxy_gl_version();
    if (!epoxy_is_desktop_gl() || version < kNeededGlVersion) {
        const bool only_clip_control =
            version == kNeededGlVersion - 1 && !epoxy_has_gl_extension("GL_ARB_clip_control");
        return tl::unexpected(
            fmt::format("the graphics driver gives OpenGL {}.{} ({}, {}){} but Eyepoint needs 4.5 core; "
                        "update the driver, or "
                        "use Mesa's software renderer with LIBGL_ALWAYS_SOFTWARE=1",
                        version / 10, version % 10, identity.renderer, identity.version,
                        only_clip_control ? ", without GL_ARB_clip_control," : ""));
    }
    if (!epoxy_has_gl_extension("GL_ARB_clip_control")) {
        return tl::unexpected(
            fmt::format("the graphics driver ({}, {}) has no GL_ARB_clip_control, which depth at planetary "
                        "range needs; update "
                        "the driver, or clear MESA_EXTENSION_OVERRIDE if it is set",
                        identity.renderer, identity.version));
    }
    return identity;
}

void log_gl_messages(const std::function<void(std::string_view)>& log) {
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glDebugMessageCallback(forward_message, &log);
}

}  // namespace eyepoint::ig
