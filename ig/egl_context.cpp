#include "ig/egl_context.hpp"

#include <array>
#include <utility>

#include <dlfcn.h>
#include <epoxy/egl.h>
#include <fmt/format.h>

namespace eyepoint::ig {

/// Display and context; released together.
struct EglContext::Handles {
    EGLDisplay display = EGL_NO_DISPLAY;
    EGLContext context = EGL_NO_CONTEXT;

    Handles() = default;
    Handles(const Handles&) = delete;
    Handles& operator=(const Handles&) = delete;
    ~Handles() {
        if (display == EGL_NO_DISPLAY) return;
        drop_context();
        eglTerminate(display);
    }

    void drop_context() {
        if (context == EGL_NO_CONTEXT) return;
        eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        eglDestroyContext(display, context);
        context = EGL_NO_CONTEXT;
    }

    /// Makes a core context of at least this version current; false if the display has none.
    bool make_current(EGLint major, EGLint minor, bool debug);
};

namespace {

constexpr const char* kNoLibrary =
    "the EGL library cannot be loaded ({}); install Debian's libegl1 and libegl-mesa0, or the graphics "
    "card's driver";
constexpr const char* kNoDriver =
    "EGL finds no driver that draws without a display; install Debian's libegl-mesa0 and libgl1-mesa-dri, or "
    "the "
    "graphics card's driver, and check __EGL_VENDOR_LIBRARY_FILENAMES and LIBGL_DRIVERS_PATH if they are set";
constexpr const char* kNoContext =
    "the EGL driver ({}) gives no desktop OpenGL context without a display; update the driver, or use Mesa's "
    "software renderer with LIBGL_ALWAYS_SOFTWARE=1";

/// Whether the dynamic linker finds EGL: libepoxy ends the process where it does not.
tl::expected<void, std::string> check_library() {
    void* library = dlopen("libEGL.so.1", RTLD_LAZY | RTLD_LOCAL);
    if (library == nullptr) return tl::unexpected(fmt::format(kNoLibrary, dlerror()));
    dlclose(library);
    return {};
}

EGLDisplay surfaceless_display() {
    if (!epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_base") ||
        !epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless")) {
        return EGL_NO_DISPLAY;
    }
    return eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
}

EGLDisplay device_display(EGLint index) {
    if (!epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_device") ||
        !epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_enumeration")) {
        return EGL_NO_DISPLAY;
    }
    std::array<EGLDeviceEXT, 16> devices{};
    EGLint count = 0;
    if (!eglQueryDevicesEXT(devices.size(), devices.data(), &count) || index >= count) return EGL_NO_DISPLAY;
    return eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, devices[static_cast<std::size_t>(index)],
                                    nullptr);
}

/// The n-th place to look for a driver: the surfaceless platform, then the devices. Not initialised.
EGLDisplay candidate_display(EGLint n) { return n == 0 ? surfaceless_display() : device_display(n - 1); }

EGLConfig config_of(EGLDisplay display) {
    if (epoxy_has_egl_extension(display, "EGL_KHR_no_config_context")) return EGL_NO_CONFIG_KHR;
    const std::array<EGLint, 5> wanted{EGL_SURFACE_TYPE, EGL_DONT_CARE, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT,
                                       EGL_NONE};
    EGLConfig config = EGL_NO_CONFIG_KHR;
    EGLint count = 0;
    eglChooseConfig(display, wanted.data(), &config, 1, &count);
    return config;
}

/// Why a driver that gave no 4.5 core context did not: by what an older context says of itself.
template <typename Handles>
std::string describe_shortcoming(Handles& handles) {
    const char* vendor = eglQueryString(handles.display, EGL_VENDOR);
    if (!handles.make_current(3, 1, false))
        return fmt::format(kNoContext, vendor == nullptr ? "unknown" : vendor);
    const auto identity = check_current_context();
    return identity ? fmt::format(kNoContext, identity->renderer) : identity.error();
}

}  // namespace

bool EglContext::Handles::make_current(EGLint major, EGLint minor, bool debug) {
    const std::array<EGLint, 9> attributes{EGL_CONTEXT_MAJOR_VERSION,
                                           major,
                                           EGL_CONTEXT_MINOR_VERSION,
                                           minor,
                                           EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                           EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                           EGL_CONTEXT_OPENGL_DEBUG,
                                           debug ? EGL_TRUE : EGL_FALSE,
                                           EGL_NONE};
    if (!eglBindAPI(EGL_OPENGL_API)) return false;
    context = eglCreateContext(display, config_of(display), EGL_NO_CONTEXT, attributes.data());
    if (context == EGL_NO_CONTEXT) return false;
    if (eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context)) return true;
    drop_context();
    return false;
}

tl::expected<EglContext, std::string> EglContext::create(bool debug) {
    if (const auto library = check_library(); !library) return tl::unexpected(library.error());
    std::string fault = kNoDriver;
    for (EGLint n = 0;; ++n) {
        auto handles = std::make_unique<Handles>();
        const EGLDisplay display = candidate_display(n);
        if (display == EGL_NO_DISPLAY && n > 0) return tl::unexpected(fault);
        if (display == EGL_NO_DISPLAY || !eglInitialize(display, nullptr, nullptr)) continue;
        handles->display = display;
        if (!handles->make_current(4, 5, debug)) {
            fault = describe_shortcoming(*handles);
            continue;
        }
        auto identity = check_current_context();
        if (identity) return EglContext{std::move(handles), *std::move(identity)};
        fault = identity.error();
    }
}

EglContext::EglContext(std::unique_ptr<Handles> handles, GlIdentity identity)
    : handles_(std::move(handles)), identity_(std::move(identity)) {}
EglContext::~EglContext() = default;
EglContext::EglContext(EglContext&&) noexcept = default;
EglContext& EglContext::operator=(EglContext&&) noexcept = default;

}  // namespace eyepoint::ig
