#include "tools/bench/regression/gl_census.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <type_traits>
#include <utility>
#include <vector>

#include <epoxy/egl.h>
#include <epoxy/gl.h>

namespace eyepoint::tools {

namespace {

using Steady = std::chrono::steady_clock;

/// What a driver may make code for: the program, and the state around it.
using StatePair = std::array<GLint, 13>;

/// GL functions are called without an argument of the census's own, so what they count must stand alone.
struct Counted {
    Steady::duration in_gl{};
    std::uint64_t calls = 0;
    std::uint64_t programs = 0;
    std::vector<StatePair> pairs;
};
Counted counted;

StatePair current_pair() {
    constexpr std::array kNames{GLenum{GL_CURRENT_PROGRAM}, GLenum{GL_VERTEX_ARRAY_BINDING},
                                GLenum{GL_DRAW_FRAMEBUFFER_BINDING}, GLenum{GL_DEPTH_FUNC},
                                GLenum{GL_DEPTH_WRITEMASK}};
    constexpr std::array kSwitches{GLenum{GL_DEPTH_TEST}, GLenum{GL_CULL_FACE}, GLenum{GL_BLEND},
                                   GLenum{GL_POLYGON_OFFSET_FILL}};
    StatePair pair{};
    std::size_t at = 0;
    for (const GLenum name : kNames) glGetIntegerv(name, &pair[at++]);
    for (const GLenum name : kSwitches) pair[at++] = glIsEnabled(name);
    glGetIntegerv(GL_COLOR_WRITEMASK, &pair[at]);
    return pair;
}

void note_draw() {
    const StatePair pair = current_pair();
    if (std::find(counted.pairs.begin(), counted.pairs.end(), pair) == counted.pairs.end())
        counted.pairs.push_back(pair);
}

/// Adds the time of its life.
class Timed {
  public:
    Timed() { ++counted.calls; }
    ~Timed() { counted.in_gl += Steady::now() - begin_; }
    Timed(const Timed&) = delete;
    Timed& operator=(const Timed&) = delete;

  private:
    Steady::time_point begin_ = Steady::now();
};

enum class Kind : std::uint8_t { Plain, Draws, Links };

/// A GL function by way of the counters. Slot: libepoxy's pointer.
template <Kind kKind, typename Signature, Signature*& Slot>
struct Counter;

template <Kind kKind, typename Result, typename... Arguments, Result (*&Slot)(Arguments...)>
struct Counter<kKind, Result(Arguments...), Slot> {
    static inline Result (*real)(Arguments...) = nullptr;
    static inline Result (*before)(Arguments...) = nullptr;

    static Result call(Arguments... arguments) {
        if constexpr (kKind == Kind::Draws) note_draw();
        if constexpr (kKind == Kind::Links) ++counted.programs;
        const Timed timed;
        return real(arguments...);
    }
    /// libepoxy's own pointer may be one that puts another in its place when it is first called.
    static void install(const char* name) {
        real = reinterpret_cast<Result (*)(Arguments...)>(eglGetProcAddress(name));
        if (real == nullptr) return;
        before = std::exchange(Slot, &call);
    }
    static void remove() {
        if (real != nullptr) Slot = before;
    }
};

struct Installation {
    void (*install)(const char* name);
    void (*remove)();
    const char* name;
};

/// function: without its "gl", as libepoxy defines the names that have it.
#define EYEPOINT_COUNTER(kind, function)                                                                     \
    Installation {                                                                                           \
        &Counter<kind, std::remove_pointer_t<decltype(epoxy_gl##function)>, epoxy_gl##function>::install,    \
            &Counter<kind, std::remove_pointer_t<decltype(epoxy_gl##function)>, epoxy_gl##function>::remove, \
            "gl" #function                                                                                   \
    }
#define EYEPOINT_PLAIN(function) EYEPOINT_COUNTER(Kind::Plain, function)

/// All that a frame calls; the time of one that is missing here counts as outside GL.
const std::array kInstallations{
    EYEPOINT_COUNTER(Kind::Draws, DrawArrays),
    EYEPOINT_COUNTER(Kind::Draws, DrawElements),
    EYEPOINT_COUNTER(Kind::Draws, DrawElementsBaseVertex),
    EYEPOINT_COUNTER(Kind::Draws, MultiDrawElementsBaseVertex),
    EYEPOINT_COUNTER(Kind::Links, LinkProgram),
    EYEPOINT_PLAIN(BindBufferBase),
    EYEPOINT_PLAIN(BindFramebuffer),
    EYEPOINT_PLAIN(BindTextureUnit),
    EYEPOINT_PLAIN(BindVertexArray),
    EYEPOINT_PLAIN(Clear),
    EYEPOINT_PLAIN(ClearColor),
    EYEPOINT_PLAIN(ClearDepth),
    EYEPOINT_PLAIN(ClientWaitSync),
    EYEPOINT_PLAIN(ClipControl),
    EYEPOINT_PLAIN(ColorMask),
    EYEPOINT_PLAIN(CopyNamedBufferSubData),
    EYEPOINT_PLAIN(CreateBuffers),
    EYEPOINT_PLAIN(DeleteBuffers),
    EYEPOINT_PLAIN(DeleteSync),
    EYEPOINT_PLAIN(DepthFunc),
    EYEPOINT_PLAIN(DepthMask),
    EYEPOINT_PLAIN(Disable),
    EYEPOINT_PLAIN(Enable),
    EYEPOINT_PLAIN(FenceSync),
    EYEPOINT_PLAIN(GetIntegerv),
    EYEPOINT_PLAIN(GetNamedFramebufferAttachmentParameteriv),
    EYEPOINT_PLAIN(IsEnabled),
    EYEPOINT_PLAIN(MapNamedBufferRange),
    EYEPOINT_PLAIN(NamedBufferData),
    EYEPOINT_PLAIN(NamedBufferStorage),
    EYEPOINT_PLAIN(NamedBufferSubData),
    EYEPOINT_PLAIN(NamedFramebufferRenderbuffer),
    EYEPOINT_PLAIN(NamedFramebufferTexture),
    EYEPOINT_PLAIN(PixelStorei),
    EYEPOINT_PLAIN(ReadPixels),
    EYEPOINT_PLAIN(TextureBuffer),
    EYEPOINT_PLAIN(TextureSubImage3D),
    EYEPOINT_PLAIN(Uniform4fv),
    EYEPOINT_PLAIN(UnmapNamedBuffer),
    EYEPOINT_PLAIN(UseProgram),
    EYEPOINT_PLAIN(VertexArrayElementBuffer),
    EYEPOINT_PLAIN(VertexArrayVertexBuffer),
    EYEPOINT_PLAIN(Viewport),
};

#undef EYEPOINT_PLAIN
#undef EYEPOINT_COUNTER

}  // namespace

GlCensus::GlCensus() {
    counted = {};
    constexpr std::size_t kPairsWithoutAllocation = 256;
    counted.pairs.reserve(kPairsWithoutAllocation);
    for (const Installation& installation : kInstallations) installation.install(installation.name);
}

GlCensus::~GlCensus() {
    for (const Installation& installation : kInstallations) installation.remove();
}

GlCensus::Count GlCensus::count() const {
    return {std::chrono::duration<double, std::milli>(counted.in_gl).count(), counted.calls, counted.programs,
            counted.pairs.size()};
}

}  // namespace eyepoint::tools
