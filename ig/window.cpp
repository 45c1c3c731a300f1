#include "ig/window.hpp"

#include <algorithm>
#include <utility>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>

namespace eyepoint::ig {

namespace {

std::string last_glfw_error() {
    const char* description = nullptr;
    glfwGetError(&description);
    return description == nullptr ? "no reason given" : description;
}

void set_hints(bool debug) {
    glfwWindowHint(GLFW_CLIENT_API, GLFW_OPENGL_API);
    glfwWindowHint(GLFW_CONTEXT_CREATION_API, GLFW_EGL_CONTEXT_API);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_DEBUG_CONTEXT, debug ? GLFW_TRUE : GLFW_FALSE);
    glfwWindowHint(GLFW_DEPTH_BITS, 0);  // depth lives in the FrameBuffer
    glfwWindowHint(GLFW_STENCIL_BITS, 0);
}

}  // namespace

Window::Library::Library() : ready(glfwInit() == GLFW_TRUE) {}
Window::Library::~Library() {
    if (ready) glfwTerminate();
}

void Window::Destroy::operator()(GLFWwindow* window) const { glfwDestroyWindow(window); }

tl::expected<Window, std::string> Window::create(const Options& options) {
    Window made;
    made.glfw_ = std::make_unique<Library>();
    if (!made.glfw_->ready) {
        return tl::unexpected(
            fmt::format("there is no display to open a window on ({}); set DISPLAY, or use --headless "
                        "with --output, --video or --none",
                        last_glfw_error()));
    }
    set_hints(options.debug);
    made.window_.reset(glfwCreateWindow(options.size.width_px, options.size.height_px, options.title.c_str(),
                                        nullptr, nullptr));
    if (made.window_ == nullptr) {
        return tl::unexpected(
            fmt::format("no window with OpenGL 4.5 core through EGL can be opened ({}); update the "
                        "graphics driver, or use --headless with --output, --video or --none",
                        last_glfw_error()));
    }
    made.heard_ = std::make_unique<Heard>();
    glfwSetWindowUserPointer(made.window_.get(), made.heard_.get());
    glfwSetKeyCallback(made.window_.get(), hear_key);
    glfwSetWindowRefreshCallback(made.window_.get(), hear_damage);
    glfwMakeContextCurrent(made.window_.get());
    glfwSwapInterval(0);
    auto identity = check_current_context();
    if (!identity) return tl::unexpected(identity.error());
    made.identity_ = *std::move(identity);
    return made;
}

PictureSize Window::size() const {
    PictureSize size;
    glfwGetFramebufferSize(window_.get(), &size.width_px, &size.height_px);
    return {std::max(size.width_px, 1), std::max(size.height_px, 1)};
}

bool Window::close_requested() const {
    return glfwWindowShouldClose(window_.get()) == GLFW_TRUE ||
           glfwGetKey(window_.get(), GLFW_KEY_ESCAPE) == GLFW_PRESS;
}

void Window::hear_key(GLFWwindow* window, int key, int, int action, int) {
    auto& heard = *static_cast<Heard*>(glfwGetWindowUserPointer(window));
    if (action != GLFW_PRESS) return;
    if (key == GLFW_KEY_N) heard.show = Show::Terrain;
    if (key == GLFW_KEY_W) heard.show = Show::Wireframe;
    if (key == GLFW_KEY_L) heard.show = Show::Levels;
    if (key == GLFW_KEY_H) heard.hud_switched = !heard.hud_switched;
}

void Window::hear_damage(GLFWwindow* window) {
    static_cast<Heard*>(glfwGetWindowUserPointer(window))->damaged = true;
}

bool Window::take_damage() { return std::exchange(heard_->damaged, false); }

std::optional<Show> Window::wanted_show() const { return heard_->show; }

bool Window::hud_switched() const { return heard_->hud_switched; }

void Window::handle_events() { glfwPollEvents(); }

void Window::swap() { glfwSwapBuffers(window_.get()); }

}  // namespace eyepoint::ig
