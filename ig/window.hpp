/// A window on the display, with an OpenGL context.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include <tl/expected.hpp>

#include "ig/gl_identity.hpp"
#include "ig/picture.hpp"
#include "ig/shading.hpp"

struct GLFWwindow;

namespace eyepoint::ig {

/// A GLFW window whose OpenGL 4.5 core context (through EGL) is current on the thread that made it. It can be
/// resized; Esc or the window's close button ask for the end. Frames are shown without waiting for the
/// display's refresh: the frame clock alone paces. One at a time in a process. Thread use: the main thread.
class Window {
  public:
    struct Options {
        std::string title;
        PictureSize size;
        bool debug = false;  ///< a debug context, for log_gl_messages()
    };

    /// On failure (no display, no 4.5 core): one sentence with the remedy.
    [[nodiscard]] static tl::expected<Window, std::string> create(const Options& options);

    [[nodiscard]] const GlIdentity& identity() const { return identity_; }
    /// Of the drawable area, pixels; at least 1x1, also while the window is an icon.
    [[nodiscard]] PictureSize size() const;
    [[nodiscard]] bool close_requested() const;
    /// What the newest of the keys N (normal), W (wireframe) and L (levels) asked for; none before one was
    /// hit.
    [[nodiscard]] std::optional<Show> wanted_show() const;
    /// Whether the key H has been hit an odd number of times.
    [[nodiscard]] bool hud_switched() const;
    /// True once after the window's content was lost (uncovered, resized).
    [[nodiscard]] bool take_damage();
    /// Takes in the keyboard and the window's events; once a frame.
    void handle_events();
    /// Shows what has been drawn into the default framebuffer.
    void swap();

  private:
    /// The library is shut down after the window is gone.
    struct Library {
        bool ready = false;
        Library();
        ~Library();
    };
    struct Destroy {
        void operator()(GLFWwindow* window) const;
    };

    /// What the window's callbacks have heard.
    struct Heard {
        std::optional<Show> show;
        bool hud_switched = false;
        bool damaged = false;
    };
    static void hear_key(GLFWwindow* window, int key, int scancode, int action, int modifiers);
    static void hear_damage(GLFWwindow* window);

    std::unique_ptr<Library> glfw_;
    std::unique_ptr<Heard> heard_;  ///< where GLFW's callback finds it when the window is moved
    std::unique_ptr<GLFWwindow, Destroy> window_;
    GlIdentity identity_;
};

}  // namespace eyepoint::ig
