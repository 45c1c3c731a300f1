#include "ig/control/timer_query_check.hpp"

#include <algorithm>
#include <array>
#include <chrono>

#include <epoxy/gl.h>
#include <fmt/format.h>

#include "ig/gpu_fence.hpp"

namespace eyepoint::ig {

namespace {

constexpr std::size_t kChecks = 5;
/// Shorter work says more of the driver than of the clocks.
constexpr double kTellingMs = 0.2;

/// GL_TIME_ELAPSED.
class TimerQuery {
  public:
    TimerQuery() { glGenQueries(1, &name_); }
    ~TimerQuery() { glDeleteQueries(1, &name_); }
    TimerQuery(const TimerQuery&) = delete;
    TimerQuery& operator=(const TimerQuery&) = delete;

    void begin() const { glBeginQuery(GL_TIME_ELAPSED, name_); }
    void end() const { glEndQuery(GL_TIME_ELAPSED); }
    /// Milliseconds, of work that a fence has seen finished; none when the query still has no answer.
    [[nodiscard]] std::optional<double> elapsed_ms() const {
        GLint available = GL_FALSE;
        glGetQueryObjectiv(name_, GL_QUERY_RESULT_AVAILABLE, &available);
        if (available == GL_FALSE) return std::nullopt;
        GLuint64 ns = 0;
        glGetQueryObjectui64v(name_, GL_QUERY_RESULT, &ns);
        return static_cast<double>(ns) * 1e-6;
    }

  private:
    GLuint name_ = 0;
};

double median(std::array<double, kChecks> values) {
    std::ranges::sort(values);
    return values[kChecks / 2];
}

}  // namespace

bool timers_agree(double query_ms, double fence_ms) {
    return fence_ms >= kTellingMs && query_ms <= fence_ms * 1.02 &&
           query_ms >= fence_ms * (1.0 - kTimerAgreement);
}

std::optional<TimerQueryCheck> check_timer_queries(const std::function<void()>& draw) {
    GLint bits = 0;
    glGetQueryiv(GL_TIME_ELAPSED, GL_QUERY_COUNTER_BITS, &bits);
    if (bits == 0) return std::nullopt;
    const TimerQuery query;
    std::array<double, kChecks> queried{}, fenced{};
    for (std::size_t i = 0; i < kChecks; ++i) {
        if (!wait_for_gpu()) return std::nullopt;
        const auto begin = std::chrono::steady_clock::now();
        query.begin();
        draw();
        query.end();
        if (!wait_for_gpu()) return std::nullopt;
        const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begin;
        const auto elapsed_ms = query.elapsed_ms();
        if (!elapsed_ms) return std::nullopt;
        queried[i] = *elapsed_ms;
        fenced[i] = took.count();
    }
    const double query_ms = median(queried), fence_ms = median(fenced);
    return TimerQueryCheck{query_ms, fence_ms, timers_agree(query_ms, fence_ms)};
}

std::string describe(const std::optional<TimerQueryCheck>& check) {
    if (!check) return "GL timer queries: there are none; frames are timed by fences";
    if (check->agrees)
        return fmt::format("GL timer queries agree with fences ({:.2f} ms of {:.2f})", check->query_ms,
                           check->fence_ms);
    return fmt::format("GL timer queries see {:.2f} ms of {:.2f}; frames are timed by fences",
                       check->query_ms, check->fence_ms);
}

}  // namespace eyepoint::ig
